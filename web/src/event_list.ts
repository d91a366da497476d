// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import { eventName } from './events';
import type { Live } from './live';

const most = 200; // maximum number of events listed

/** The events of a run; a click on one shows its time. */
export function eventList(live: Live, seek: (time: number) => void): HTMLElement[] {
  const list = element('ol', { class: 'events' });
  let listed = -1;
  const show = () => {
    const { events } = live.history;
    if (events.length === listed) return;
    listed = events.length;
    const items = events.slice(0, most).map(({ t_s, kind }) => {
      const button = element(
        'button',
        { type: 'button', class: 'quiet', onclick: () => seek(t_s) },
        `${t_s.toFixed(1)} s`,
      );
      return element('li', {}, button, ` ${eventName(kind)}`);
    });
    const rest = events.length - items.length;
    if (events.length === 0) items.push(element('li', { class: 'doc' }, 'None so far.'));
    if (rest > 0)
      items.push(
        element('li', { class: 'doc' }, `and ${rest} more: ${live.isServed ? 'events.csv' : 'the record'} has all.`),
      );
    list.replaceChildren(...items);
  };
  live.listen((message) => {
    if (message.type === 'rows') show();
  });
  return [element('h2', {}, 'Events'), list];
}
