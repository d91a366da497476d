// SPDX-License-Identifier: Apache-2.0
import type { Live } from './live';
import { Stick } from './stick';
import { at } from './settings';

const period = 100; // ms between commands
const deadZone = 0.15; // share of a stick's range
const arrows: { [key: string]: [number, number] } = {
  ArrowRight: [1, 0],
  ArrowLeft: [-1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** Steering by hand: arrow keys, slow with Shift, a stick on the screen, or the left stick of a gamepad. */
export class Drive {
  private readonly pressed = new Set<string>();
  private isSlow = false;
  readonly stick = new Stick((x, y) => {
    this.touched = [x, y];
    this.send();
  });
  private touched: [number, number] = [0, 0];
  private moves = false;
  private readonly timer = window.setInterval(() => this.send(), period);

  constructor(private readonly live: Live) {
    live.listen((message) => {
      if (message.type === 'standing') this.stick.show(message.mode === 'manual');
    });
  }

  get isManual(): boolean {
    return this.live.standing?.mode === 'manual';
  }

  toggle(): void {
    this.pressed.clear();
    void this.live.ask({ do: 'manual', on: !this.isManual });
  }

  /** Takes an arrow key during manual steering; returns whether it did. */
  key(event: KeyboardEvent, down: boolean): boolean {
    this.isSlow = event.shiftKey;
    if (!arrows[event.key]) return false;
    if (!down) this.pressed.delete(event.key);
    if (!this.isManual) return false;
    if (down) this.pressed.add(event.key);
    if (!event.repeat) this.send();
    return true;
  }

  release(): void {
    this.pressed.clear();
    this.stick.release();
  }

  destroy(): void {
    window.clearInterval(this.timer);
  }

  private direction(): [number, number] {
    let [x, y] = [0, 0];
    for (const key of this.pressed) {
      const [dx, dy] = arrows[key] as [number, number];
      x += dx;
      y += dy;
    }
    if (x !== 0 || y !== 0) {
      const scale = (this.isSlow ? 0.3 : 1) / Math.hypot(x, y);
      return [x * scale, y * scale];
    }
    if (this.touched.some((one) => one !== 0)) return this.touched;
    const pad = navigator.getGamepads().find((one) => one?.connected);
    const stick: [number, number] = [pad?.axes[0] ?? 0, -(pad?.axes[1] ?? 0)];
    return Math.hypot(...stick) > deadZone ? stick : [0, 0];
  }

  private send(): void {
    if (!this.isManual) return;
    const [x, y] = this.direction();
    const share = Math.min(1, Math.hypot(x, y));
    if (share === 0 && !this.moves) return;
    this.moves = share > 0;
    const scenario = this.live.hello?.scenario;
    const fastest = Number(at(scenario, 'robots.max_speed_um_per_s') ?? at(scenario, 'swarm.max_speed_um_per_s') ?? 0);
    void this.live.ask({ do: 'steer', heading: Math.atan2(y, x), speed: share * fastest });
  }
}
