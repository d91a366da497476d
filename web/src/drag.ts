// SPDX-License-Identifier: Apache-2.0
import type { Json } from './protocol';

const period = 150; // ms between two values of a drag

/**
 * Values of a slider that act while it is dragged: one is on its way at a time, and of those meanwhile the newest.
 * The value before the drag is kept, so that one drag is one change.
 */
export class Drag {
  private key = '';
  private before: Json | undefined;
  private newest: Json | undefined; // not sent yet
  private sends = false;

  constructor(
    private readonly send: (key: string, value: Json) => Promise<unknown>,
    private readonly pause: (ms: number) => Promise<unknown> = (ms) => new Promise((done) => setTimeout(done, ms)),
  ) {}

  /** Takes a value of a drag; `before` is that of the key now. */
  move(key: string, value: Json, before: Json | undefined): void {
    if (key !== this.key) {
      this.key = key;
      this.before = before;
    }
    this.newest = value;
    if (!this.sends) void this.run();
  }

  /** Ends the drag of a key: drops what was not sent, and returns the value before the drag if there was one. */
  end(key: string): Json | undefined {
    if (key !== this.key) return undefined;
    const { before } = this;
    this.key = '';
    this.before = this.newest = undefined;
    return before;
  }

  private async run(): Promise<void> {
    this.sends = true;
    while (this.newest !== undefined) {
      const value = this.newest;
      this.newest = undefined;
      await this.send(this.key, value);
      await this.pause(period);
    }
    this.sends = false;
  }
}
