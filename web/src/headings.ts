// SPDX-License-Identifier: Apache-2.0

/** Name of a folder as a heading: its path below the nearest folder `scenarios`, else its last two parts. */
export function heading(folder: string): string {
  const parts = folder.split('/').filter((one) => one !== '');
  const shipped = parts.lastIndexOf('scenarios');
  const shown = shipped >= 0 ? parts.slice(shipped + 1) : parts.slice(-2);
  if (shown.some((one) => /^microswarm-[A-Za-z0-9]{6}$/.test(one))) return 'Opened here'; // temporary
  return shown.length > 0 ? shown.join(' › ').replaceAll('_', ' ') : 'First steps';
}

export interface Entry {
  file: string;
  name: string;
  description: string;
  record: boolean;
  navigator: string;
  outcome: string;
  written: string;
  trouble: string;
}

/** Texts of an entry's card: its name, what it is, and why it cannot be opened, if so. */
export function cardText(entry: Entry): { name: string; text: string; trouble: string } {
  const { trouble } = entry;
  if (!entry.record) return { name: entry.name, text: entry.description, trouble };
  const parts = [entry.outcome, entry.navigator, entry.written]
    .filter((one) => one !== '')
    .map((one) => one.replaceAll('_', ' '));
  const folder = entry.file.split('/').at(-2) ?? '';
  // Most records are called run.h5: their folders distinguish them.
  return {
    name: entry.name === 'run' && folder ? `${folder} / run` : entry.name,
    text: [`Record of ${entry.description || 'a run'}`, ...parts].join(' · '),
    trouble,
  };
}

const largest = 64 * 1024 * 1024; // bytes, as the server takes

/** Reason why a file cannot be taken; empty if it can. */
export function refusal(name: string, bytes: number): string {
  return bytes > largest
    ? `${name} has ${Math.ceil(bytes / 1024 / 1024)} MiB; at most ${largest / 1024 / 1024} MiB can be opened here.`
    : '';
}
