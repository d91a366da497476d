// SPDX-License-Identifier: Apache-2.0
import type { Standing } from './protocol';

type State = Pick<Standing, 'growing' | 'mode' | 'ended' | 'state' | 'status' | 'plays' | 'frames'>;

/** State of a run in a word or two. */
export function statusText(standing: State, isRecord: boolean): string {
  if (standing.growing) return 'still being written';
  if (standing.ended || isRecord) return plain(standing.status);
  if (standing.frames === 0 && !standing.plays) return 'not begun';
  const state = plain(standing.state || standing.status);
  const mode = standing.mode === 'autonomous' || standing.mode === state ? state : `${standing.mode} · ${state}`;
  return standing.plays ? mode : `paused · ${mode}`;
}

function plain(word: string): string {
  return word.replaceAll('_', ' ');
}
