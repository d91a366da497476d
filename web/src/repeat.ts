// SPDX-License-Identifier: Apache-2.0
// Texts on how a run is repeated, and on the time of which numbers are.
import type { Hello, Standing } from './protocol';
import { shellWord } from './settings';

type Source = Pick<Hello, 'command' | 'playback'>;
type Done = Pick<Standing, 'changes' | 'steered'>;

export interface Repeat {
  changes: string[];
  /** Text in place of an empty list. */
  none: string;
  command: string;
  /** Whether the command repeats the run, and what does if not. */
  note: string;
}

export function repeatOf({ command, playback }: Source, { changes, steered }: Done): Repeat {
  const byHand = steered ? 'It was held or steered by hand.' : '';
  if (playback)
    return {
      changes,
      none: `None. ${byHand}`.trim(),
      command,
      note: 'This command repeats the recorded run and compares it with the record.',
    };
  const made = {
    changes,
    none: steered ? `None. ${byHand}` : 'None so far.',
    command: command + changes.map((one) => ` --set ${shellWord(one)}`).join(''),
  };
  const record = 'The record repeats it: microswarm replay record.h5.';
  if (steered)
    return { ...made, note: `The run was held or steered by hand, so no command line repeats it. ${record}` };
  if (changes.length > 0)
    return { ...made, note: `This command applies the changes from the start, so its run is another one. ${record}` };
  return { ...made, note: 'This command repeats the run.' };
}

/** Heading of the metrics, with the time of which they are where the picture is of another. */
export function metricsHeading(
  playback: boolean,
  standing: Pick<Standing, 'looks_back' | 'growing' | 'metrics'> | undefined,
): string {
  if (playback) return standing?.growing ? 'Metrics of the record so far' : 'Metrics of the whole record';
  return standing?.looks_back ? `Metrics up to ${Number(standing.metrics['time_s']).toFixed(1)} s` : 'Metrics so far';
}

/** Note on parameters and decisions while an earlier time is in the picture; empty if it is none. */
export function parametersNote(
  playback: boolean,
  standing: Pick<Standing, 'looks_back' | 'changes'> | undefined,
  shown: number,
): string {
  const { looks_back: looksBack, changes } = standing ?? { looks_back: false, changes: [] };
  return looksBack || (playback && changes.length > 0) ? `These are the values at ${shown.toFixed(1)} s.` : '';
}

/** Note on decisions that a long run no longer has; empty if it has all. */
export function decisionsNote(standing: Pick<Standing, 'looks_back' | 'decisions_every'> | undefined): string {
  const every = standing?.looks_back ? standing.decisions_every : 1;
  return every > 1
    ? `Decisions of this run are kept of one frame in ${every}: others show none. With record.diagnostics all are kept.`
    : '';
}
