// SPDX-License-Identifier: Apache-2.0
import type { Answer } from './protocol';

const noticed = 3000; // time without an answer after which that is said [ms]
const longest = 60_000; // time after which a request counts as not answered [ms]

const late = 'The run has not answered for a while: it is busy with a long step, or the lab stands still.';
const never: Answer = {
  type: 'answer',
  id: 0,
  issues: [{ keys: [], text: 'No answer in a minute: it may still take effect.' }],
};

/** Watches the answers of a session: says when one is late, and ends the wait for one that does not come. */
export class Patience {
  private late = 0;

  constructor(private readonly say: (text: string) => void) {}

  async of(answer: Promise<Answer>): Promise<Answer> {
    let isLate = false;
    let end: ReturnType<typeof setTimeout> | undefined;
    const notice = setTimeout(() => {
      isLate = true;
      if (++this.late === 1) this.say(late);
    }, noticed);
    const none = new Promise<Answer>((resolve) => (end = setTimeout(() => resolve(never), longest)));
    try {
      const first = await Promise.race([answer, none]);
      if (isLate && first !== never) this.answered();
      else if (isLate) void answer.then(() => this.answered());
      return first;
    } finally {
      clearTimeout(notice);
      clearTimeout(end);
    }
  }

  private answered(): void {
    if (--this.late === 0) this.say('');
  }
}
