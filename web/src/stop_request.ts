// SPDX-License-Identifier: Apache-2.0

const answerTime = 500; // maximum time of the answer to a stop [ms]

/** A stop that a person asked for, and whether it is answered in time. */
export class StopRequest {
  private asked = 0; // number of the last stop
  /** Whether a stop has no answer in time. */
  isUnanswered = false;

  /** `changed` is called after isUnanswered changed. */
  constructor(private readonly changed: () => void) {}

  /** Sends a stop. `isLost`: whether the stream is broken, which answers too, with the number 0. */
  async send(stop: () => Promise<{ id: number } | undefined>, isLost: () => boolean): Promise<void> {
    const own = ++this.asked;
    const late = setTimeout(() => this.set(true), answerTime);
    const answer = await stop();
    clearTimeout(late);
    if (own === this.asked) this.set(isLost() || answer?.id === 0);
  }

  /** Takes the news that the rig has stopped. */
  hasStopped(): void {
    this.isUnanswered = false;
  }

  private set(isUnanswered: boolean): void {
    this.isUnanswered = isUnanswered;
    this.changed();
  }
}
