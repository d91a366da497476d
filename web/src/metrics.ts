// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import type { History } from './history';
import { number, words } from './numbers';
import type { Json } from './protocol';

export interface Metric {
  key: string;
  label: string;
  unit: string;
  value: number | undefined;
}

/** Labels within a group whose key says too little. */
const within: { [key: string]: string } = { clearance_um: 'least clearance', t_s: 'time of the least' };

/** Metrics of a run as one list; nested ones have their group's name as prefix. */
export function metricsOf(metrics: { [key: string]: Json }, group = ''): Metric[] {
  return Object.entries(metrics).flatMap(([key, value]) => {
    const { label, unit } = words(key);
    if (value !== null && typeof value === 'object' && !Array.isArray(value))
      return metricsOf(value, `${group}${label}: `);
    return [
      {
        key: group + key,
        label: group + ((group && within[key]) || label),
        unit,
        value: typeof value === 'number' ? value : undefined,
      },
    ];
  });
}

const momentary = ['clearance_um', 'goal_distance_um', 'speed_um_per_s', 'avoidance_cost', 'step_time_s'];

/** Numbers of one tick. */
export function numbersAt(history: History, frame: number): { [key: string]: Json } {
  return Object.fromEntries(momentary.map((name) => [name, history.column(name)[frame] ?? null]));
}

/** Time and state of a tick, as a heading of its numbers. */
export function headingAt(history: History, frame: number, states: string[]): string {
  const state = states[history.column('state')[frame] ?? -1];
  return `At ${(history.times[frame] ?? 0).toFixed(1)} s${state ? `: ${state.replaceAll('_', ' ')}` : ''}`;
}

/** Table of the metrics of one or more runs, with the difference of two. */
export function metricsTable(names: string[], runs: { [key: string]: Json }[]): HTMLElement {
  const lists = runs.map((one) => metricsOf(one));
  const heads = names.length > 1 ? [...names, ...(names.length === 2 ? ['B − A'] : [])] : [''];
  const shown = (value: number | undefined) => (value === undefined ? '–' : number(value));
  const rows = (lists[0] ?? []).map((metric) => {
    const values = lists.map((list) => list.find((one) => one.key === metric.key)?.value);
    const cells = values.map((value) => element('td', {}, shown(value)));
    if (values.length === 2) {
      const [a, b] = values;
      const difference = a === undefined || b === undefined ? undefined : differenceOf(a, b);
      const sign = difference !== undefined && difference > 0 ? '+' : '';
      cells.push(element('td', { class: difference ? 'differs' : '' }, sign + shown(difference)));
    }
    return element(
      'tr',
      { 'data-metric': metric.key },
      element('th', { scope: 'row' }, metric.label),
      ...cells,
      element('td', { class: 'unit' }, metric.unit),
    );
  });
  const head = element(
    'tr',
    {},
    element('td', {}),
    ...heads.map((one) => element('th', { scope: 'col' }, one)),
    element('td', {}),
  );
  return element(
    'table',
    { class: 'metrics' },
    ...(names.length > 1 ? [element('thead', {}, head)] : []),
    element('tbody', {}, ...rows),
  );
}

/** B − A; zero for a rounding error. */
function differenceOf(a: number, b: number): number {
  return Math.abs(b - a) < 1e-9 * Math.max(Math.abs(a), Math.abs(b)) ? 0 : b - a;
}
