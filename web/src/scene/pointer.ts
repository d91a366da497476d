// SPDX-License-Identifier: Apache-2.0
import type { Point } from '../protocol';
import type { View } from './view';

export interface Grip {
  kind: 'goal' | 'start' | 'obstacle' | 'map';
  index?: number; // of the robot, or the obstacle's number
}

/** A drag. A click on the empty map is a begin and an end at one position. */
export interface Touch {
  phase: 'begin' | 'move' | 'end';
  what: Grip;
  from: Point; // initial position of goal or start, else of the pointer [µm]
  at: Point; // current position [µm]
}

/** Interface of the scene for the pointer. */
export interface Touched {
  readonly view: View;
  /** The object at a screen position, and the position of a mark. */
  hit(screen: Point): { what: Grip; place?: Point };
  touch(touch: Touch): void;
  viewChanged(): void;
  /** The view was moved, not only zoomed. */
  panned(): void;
}

const click = 4; // movement that still counts as a click [px]

/** Pointer, wheel and touch on the scene's canvas: pan, zoom, drag. */
export class Pointer {
  private readonly fingers = new Map<number, Point>();
  private readonly end = new AbortController(); // of the listeners
  private drag: { what: Grip; from: Point; grip: Point } | undefined; // in µm
  private pan: { moved: number; began: Point } | undefined;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly on: Touched,
  ) {
    canvas.style.touchAction = 'none';
    const { signal } = this.end;
    canvas.addEventListener('pointerdown', (event) => this.down(event), { signal });
    canvas.addEventListener('pointermove', (event) => this.move(event), { signal });
    canvas.addEventListener('pointerup', (event) => this.up(event, false), { signal });
    canvas.addEventListener('pointercancel', (event) => this.up(event, true), { signal });
    canvas.addEventListener('wheel', (event) => this.wheel(event), { passive: false, signal });
  }

  destroy(): void {
    this.end.abort();
  }

  private place(event: MouseEvent): Point {
    const { left, top } = this.canvas.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  }

  private down(event: PointerEvent): void {
    if (event.button > 1) return;
    const at = this.place(event);
    this.canvas.setPointerCapture(event.pointerId);
    this.fingers.set(event.pointerId, at);
    if (this.fingers.size > 1) return this.letGo(true);
    const { what, place } = this.on.hit(at);
    if (what.kind === 'map' || event.button === 1 || event.shiftKey) {
      this.pan = { moved: 0, began: at };
    } else {
      const grip = this.on.view.toWorld(at);
      this.drag = { what, from: place ?? grip, grip };
      this.tell('begin', grip);
    }
    this.point(at);
  }

  private move(event: PointerEvent): void {
    const at = this.place(event);
    const before = this.fingers.get(event.pointerId);
    if (!before) return this.point(at);
    if (this.fingers.size === 2) this.pinch(event.pointerId, before, at);
    this.fingers.set(event.pointerId, at);
    if (this.drag) this.tell('move', this.on.view.toWorld(at));
    if (!this.pan) return;
    this.pan.moved = Math.max(this.pan.moved, distance(at, this.pan.began));
    if (this.pan.moved < click) return;
    this.on.panned();
    this.on.view.pan(at[0] - before[0], at[1] - before[1]);
    this.on.viewChanged();
  }

  private up(event: PointerEvent, isCancelled: boolean): void {
    const at = this.place(event);
    if (!this.fingers.delete(event.pointerId)) return;
    if (this.drag && !isCancelled) this.tell('end', this.on.view.toWorld(at));
    else if (this.pan && this.pan.moved < click && !isCancelled && event.button === 0) {
      const where = this.on.view.toWorld(at);
      for (const phase of ['begin', 'end'] as const)
        this.on.touch({ phase, what: { kind: 'map' }, from: where, at: where });
    }
    this.letGo(isCancelled);
    this.point(at);
  }

  /** Ends the gesture; an aborted drag returns to its initial position. */
  private letGo(isBroken: boolean): void {
    if (this.drag && isBroken) this.tell('end', this.drag.grip);
    this.drag = this.pan = undefined;
  }

  private tell(phase: Touch['phase'], pointer: Point): void {
    const { what, from, grip } = this.drag!;
    const { lo, hi } = this.on.view;
    const within = (axis: 0 | 1) => Math.min(Math.max(from[axis] + pointer[axis] - grip[axis], lo[axis]), hi[axis]);
    this.on.touch({ phase, what, from, at: [within(0), within(1)] });
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const unit = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 30 : 1;
    const steps = Math.min(Math.max(event.deltaY * unit, -300), 300);
    this.on.view.zoom(Math.exp(-steps * 0.0022), this.place(event));
    this.on.viewChanged();
  }

  private pinch(id: number, before: Point, at: Point): void {
    for (const [other, fixed] of this.fingers) {
      if (other === id) continue;
      const middle: Point = [(at[0] + fixed[0]) / 2, (at[1] + fixed[1]) / 2];
      this.on.view.pan((at[0] - before[0]) / 2, (at[1] - before[1]) / 2);
      this.on.view.zoom(distance(at, fixed) / Math.max(distance(before, fixed), 1), middle);
    }
    this.on.viewChanged();
  }

  /** Sets the cursor for the object under it. */
  private point(at: Point): void {
    const isMap = this.pan ?? (!this.drag && this.on.hit(at).what.kind === 'map');
    const isHeld = this.drag || (this.pan && this.fingers.size > 0);
    this.canvas.style.cursor = isHeld ? 'grabbing' : isMap ? '' : 'grab';
  }
}

function distance(a: Point, b: Point): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}
