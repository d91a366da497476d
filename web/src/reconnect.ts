// SPDX-License-Identifier: Apache-2.0

/** Pause before the attempt of this number, from 0, to open a broken stream again [ms]. */
export function pauseBefore(attempt: number): number {
  return Math.min(5000, 250 * 2 ** Math.min(attempt, 10));
}

/** Number of attempts that count against a stream that broke after this time [ms]; one that lived begins again. */
export function attemptsAfter(attempts: number, life: number): number {
  return life >= 5000 ? 0 : attempts;
}

/** State of a stream; `lost`: it broke and is being opened again; `closed`: it has ended. */
export type StreamState = 'open' | 'lost' | 'closed';

export interface Verdict {
  state: 'lost' | 'closed';
  text: string;
}

/** Fate of a broken stream, by the status with which the server answers for its session; undefined without an answer. */
export function verdictOf(status: number | undefined, what: string): Verdict {
  if (status === undefined)
    return {
      state: 'lost',
      text: 'The lab has ended or cannot be reached. Trying again; if it has ended, start it and open the address that it prints.',
    };
  if (status === 404)
    return {
      state: 'closed',
      text: `${what} is closed: nobody watched it for 30 minutes, or others needed its place. Open its file again from the gallery.`,
    };
  if (status === 410)
    return {
      state: 'closed',
      text: `${what} was of a lab that has ended, and another one runs here now. Open its file from the gallery.`,
    };
  if (status === 403)
    return { state: 'closed', text: 'The lab was started again: open the address that it printed last.' };
  return { state: 'lost', text: 'The connection broke. It is being opened again; the run is kept.' };
}
