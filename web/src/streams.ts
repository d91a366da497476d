// SPDX-License-Identifier: Apache-2.0
import type { StreamState } from './reconnect';

const worst: StreamState[] = ['closed', 'lost', 'open'];

/** The streams of a page as one: it is open while all are, and says what is wrong with each. */
export class Streams {
  private readonly known = new Map<number, { state: StreamState; text: string }>();

  /** Takes the state of one of them; those that were not heard of yet count as open. */
  take(which: number, state: StreamState, text: string): void {
    this.known.set(which, { state, text });
  }

  get state(): StreamState {
    const states = [...this.known.values()].map((one) => one.state);
    return worst.find((one) => states.includes(one)) ?? 'open';
  }

  get isOpen(): boolean {
    return this.state === 'open';
  }

  get text(): string {
    return [...new Set([...this.known.values()].map((one) => one.text))].filter((one) => one !== '').join(' ');
  }
}
