// SPDX-License-Identifier: Apache-2.0

/** Names of columns in files, where they differ from those of the stream: a table frames has the measured speed. */
const names: { [column: string]: string } = { speed_um_per_s: 'commanded_speed_um_per_s' };

/** Table of the columns with a row for each tick; the state as a word, what is not finite empty. */
export function csvOf(columns: Map<string, number[]>, states: string[]): string {
  const list = [...columns];
  const lines = [list.map(([name]) => names[name] ?? name).join(',')];
  const rows = list[0]?.[1].length ?? 0;
  const cell = (name: string, value: number | undefined) =>
    name === 'state' ? (states[value ?? -1] ?? String(value)) : Number.isFinite(value) ? String(value) : '';
  for (let i = 0; i < rows; ++i) lines.push(list.map(([name, values]) => cell(name, values[i])).join(','));
  return `${lines.join('\n')}\n`;
}
