// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';

/** Deflection of a stick whose knob is this far from the middle, y up; at most 1. */
export function deflection(dx: number, dy: number, reach: number): [number, number] {
  const length = Math.hypot(dx, dy);
  const scale = length > reach ? 1 / length : 1 / reach;
  return [dx * scale || 0, -dy * scale || 0];
}

/** A stick on the screen, for steering by touch or mouse. It returns to the middle when it is let go. */
export class Stick {
  readonly root: HTMLElement;
  private readonly knob = element('div', { class: 'knob' });
  private finger: number | undefined;

  /** `steer` gets each deflection. */
  constructor(private readonly steer: (x: number, y: number) => void) {
    this.root = element('div', { class: 'stick', 'aria-hidden': 'true', hidden: true }, this.knob);
    this.root.addEventListener('pointerdown', (event) => {
      if (this.finger !== undefined) return;
      event.preventDefault();
      this.finger = event.pointerId;
      this.root.setPointerCapture(event.pointerId);
      this.move(event);
    });
    this.root.addEventListener('pointermove', (event) => {
      if (event.pointerId === this.finger) this.move(event);
    });
    for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'])
      this.root.addEventListener(end, (event) => {
        if ((event as PointerEvent).pointerId === this.finger) this.release();
      });
  }

  show(isShown: boolean): void {
    if (!isShown && !this.root.hidden) this.release();
    this.root.hidden = !isShown;
  }

  release(): void {
    this.finger = undefined;
    this.place(0, 0);
  }

  private move(event: PointerEvent): void {
    const { left, top, width, height } = this.root.getBoundingClientRect();
    const [x, y] = deflection(event.clientX - left - width / 2, event.clientY - top - height / 2, width / 3);
    this.place(x, y);
  }

  private place(x: number, y: number): void {
    const reach = this.root.clientWidth / 3;
    this.knob.style.translate = `${x * reach}px ${-y * reach}px`;
    this.steer(x, y);
  }
}
