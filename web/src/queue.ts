// SPDX-License-Identifier: Apache-2.0
import { call } from './connection';
import { element } from './dom';
import type { Page } from './page';

interface Attempt {
  folder: string;
  began: string;
  status: string;
  reason: string;
  duration_s: number;
  max_temperature_degc: number | null;
}
interface Item {
  name: string;
  number: number;
  repetition: number;
  state: string;
  note: string;
  attempts: Attempt[];
}
interface Queue {
  queue: string;
  doing: string;
  active: boolean;
  items: Item[];
}

const period = 2000; // [ms]

function row(item: Item): HTMLElement {
  const last = item.attempts[item.attempts.length - 1];
  const heat = last?.max_temperature_degc;
  const cells = [
    `${item.number}`,
    `${item.name} ${item.repetition}`,
    item.state,
    `${item.attempts.length}`,
    last ? `${last.duration_s.toFixed(1)} s` : '',
    heat === null || heat === undefined ? '' : `${heat.toFixed(1)} °C`,
    item.note || last?.reason || last?.status || '',
  ];
  return element('tr', { 'data-state': item.state }, ...cells.map((text) => element('td', {}, text)));
}

/** The state of a rig's queue, renewed every two seconds; nothing can be changed here. */
export function queueSection(): Page {
  const doing = element('output', { class: 'doing' });
  const body = element('tbody', {});
  const heads = ['', 'run', 'state', 'attempts', 'time', 'hottest coil', ''];
  const head = element('tr', {}, ...heads.map((text) => element('th', { scope: 'col' }, text)));
  const root = element(
    'section',
    { class: 'queue' },
    element('h2', {}, 'Queue'),
    doing,
    element('table', {}, element('thead', {}, head), body),
  );
  let timer = 0;
  let left = false;
  const show = async () => {
    try {
      const queue = await call<Queue>('GET', '/api/queue');
      root.dataset['active'] = queue.active ? 'yes' : 'no';
      doing.replaceChildren(queue.active ? queue.doing : `${queue.doing} – no program runs this queue now`);
      body.replaceChildren(...queue.items.map(row));
    } catch (error) {
      doing.replaceChildren((error as Error).message);
    }
    if (!left) timer = window.setTimeout(() => void show(), period);
  };
  void show();
  return {
    root,
    leave: () => {
      left = true;
      window.clearTimeout(timer);
    },
  };
}
