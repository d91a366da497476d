// SPDX-License-Identifier: Apache-2.0
import type { Json, Scenario } from './protocol';
import { at, isSame, keyOf } from './settings';

/** A change that was made: the values before it by key, and whether it was made by a restart. */
export interface Step {
  before: [string, Json][];
  restarts: boolean;
}

/** The changes of a scenario, to take them back one by one. */
export class Undo {
  private readonly done: Step[] = [];

  /** Whether a change can be taken back; one that has no effect any more, as it was discarded, does not count. */
  has(scenario: Scenario): boolean {
    return this.done.some((step) => hasEffect(step, scenario));
  }

  push(step: Step): void {
    if (step.before.length > 0) this.done.push(step);
  }

  /** Removes and returns the last change that can be taken back. */
  pop(scenario: Scenario): Step | undefined {
    for (;;) {
      const step = this.done.pop();
      if (!step || hasEffect(step, scenario)) return step;
    }
  }
}

/** The step of changes that a restart makes to this scenario, given as KEY=VALUE. */
export function restartStep(settings: string[], scenario: Scenario | undefined): Step {
  const before = settings.map((one): [string, Json | undefined] => [keyOf(one), at(scenario, keyOf(one))]);
  return { before: before.filter((one): one is [string, Json] => one[1] !== undefined), restarts: true };
}

function hasEffect({ before }: Step, scenario: Scenario): boolean {
  return before.some(([key, value]) => {
    const now = at(scenario, key);
    return now !== undefined && !isSame(now, value);
  });
}
