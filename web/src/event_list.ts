// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import { eventText, isContact, nextEvent } from './events';
import type { Live } from './live';

const most = 200; // maximum number of events listed

/** The events of a run; a click on one shows its time. */
export function eventList(live: Live, seek: (time: number) => void): HTMLElement[] {
  const list = element('ol', { class: 'events' });
  let listed = -1;
  const go = (label: string, title: string, to: () => { t_s: number } | undefined) => {
    const act = () => {
      const event = to();
      if (event) seek(event.t_s);
    };
    return element('button', { type: 'button', title, onclick: act }, label);
  };
  const next = (by: number) => nextEvent(live.history.events, live.shown, by);
  const contacts = () => live.history.events.filter(isContact);
  const contact = go('Next contact', 'The contact after the time shown, else the first (c)', () => {
    return nextEvent(contacts(), live.shown, 1) ?? contacts()[0];
  });
  const buttons = element(
    'div',
    { class: 'row', hidden: true },
    go('‹ Event', 'The event before (N)', () => next(-1)),
    go('Event ›', 'The next event (n)', () => next(1)),
    contact,
  );
  const show = () => {
    const { events } = live.history;
    if (events.length === listed) return;
    listed = events.length;
    buttons.hidden = events.length === 0;
    contact.disabled = !events.some(isContact);
    const items = events.slice(0, most).map((event) => {
      const { t_s } = event;
      const button = element(
        'button',
        { type: 'button', class: 'quiet', onclick: () => seek(t_s) },
        `${t_s.toFixed(1)} s`,
      );
      return element('li', {}, button, ` ${eventText(event)}`);
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
  return [element('h2', {}, 'Events'), buttons, list];
}
