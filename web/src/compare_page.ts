// SPDX-License-Identifier: Apache-2.0
import { requireOpen } from './connection';
import { element } from './dom';
import { Keys } from './keys';
import { layersTab } from './layers_tab';
import { Live } from './live';
import { isAtRisk, mayLeave } from './loss';
import { metricsTable } from './metrics';
import { notice } from './notice';
import type { Page } from './page';
import { Parameters } from './parameters';
import { Plots } from './plots';
import { combine, keyOf } from './settings';
import { stageFor } from './stage';
import { Streams } from './streams';
import { tabs } from './tabs';
import { themeSwitch } from './theme';
import { timeBar, timeKeys } from './time_bar';

/** Two sessions side by side, with a common time and one table of metrics. */
export async function comparePage(numbers: number[]): Promise<Page> {
  const names = ['A', 'B'];
  const { root: trouble, say } = notice();
  const streams = new Streams();
  const sides = await Promise.all(
    numbers.map(async (number, i) => {
      await requireOpen(number);
      const live = new Live(number, `Run ${names[i]}`);
      live.onLate((text) => say(text || streams.text));
      live.onState((state, text) => {
        streams.take(i, state, text);
        say(streams.text);
        root.dataset['stream'] = streams.state;
        parameters.root.inert = state !== 'open';
        both.disabled = !streams.isOpen;
      });
      const parameters = new Parameters(live, `field-${names[i]}`);
      const stage = await stageFor(live);
      const own = element('span', { class: 'own' });
      const status = element('output', { class: 'status' });
      const caption = element('figcaption', {}, element('strong', {}, names[i] as string), own, status);
      const figure = element('figure', { class: 'side', 'data-side': names[i] as string }, caption, stage.scene.root);
      return { live, stage, own, status, figure, parameters };
    }),
  );
  const restart = () => Promise.all(sides.map((side, i) => side.parameters.restart([], `run ${names[i]}`)));
  const time = timeBar(
    sides.map((side) => side.live),
    restart,
  );
  const table = element('div', { class: 'table' });
  const plots = new Plots(
    sides.map((side) => side.live),
    time.transport.seekTime,
  );
  const layers = layersTab(sides.map((side) => side.stage.scene));

  const settingsOf = (live: Live) => combine(live.hello?.settings ?? [], live.standing?.changes ?? []);
  const describe = () => {
    const lists = sides.map((side) => settingsOf(side.live));
    sides.forEach((side, i) => {
      const others = new Set(lists[1 - i]);
      const own = (lists[i] ?? []).filter((one) => !others.has(one));
      const shown = own.map((one) => (one.length > 60 ? `${keyOf(one)}=…` : one)).join(' · ');
      const { live } = side;
      const status = live.standing?.ended ? live.standing.status : (live.standing?.state ?? '');
      side.own.textContent =
        shown || (lists[0]?.join() === lists[1]?.join() ? 'same settings' : 'settings of the file');
      const words = status.replaceAll('_', ' ');
      if (side.status.value !== words) side.status.value = words; // else it is read aloud each time
      side.figure.dataset['status'] = live.standing?.status ?? '';
    });
  };
  let drawn = 0;
  const show = () => {
    const isPlaying = sides.some((side) => side.live.standing?.plays);
    if (isPlaying && performance.now() - drawn < 250) return;
    drawn = performance.now();
    describe();
    table.replaceChildren(
      metricsTable(
        names,
        sides.map((side) => side.live.standing?.metrics ?? {}),
      ),
    );
  };
  for (const side of sides)
    side.live.listen((message) => {
      if (message.type === 'standing' || message.type === 'hello') show();
    });
  const fit = () => sides.forEach((side) => side.stage.scene.fit());
  const arrow = (by: number) => (event: KeyboardEvent) => time.transport.seekBy(by * (event.shiftKey ? 10 : 1));
  const keys = new Keys(
    [
      ...timeKeys(time),
      { keys: ['ArrowLeft'], shown: '←', does: 'previous frame (Shift: ten)', act: arrow(-1) },
      { keys: ['ArrowRight'], shown: '→', does: 'next frame (Shift: ten)', act: arrow(1) },
      { keys: ['f'], shown: 'f', does: 'fit the maps', act: fit },
    ],
    true,
    () => streams.isOpen,
  );
  const both = element('button', { type: 'button', class: 'both', onclick: () => void restart() }, 'Restart both');
  document.title = 'Compare – microswarm lab';
  const root = element(
    'div',
    { class: 'session compare' },
    element(
      'nav',
      { class: 'top' },
      element('a', { href: '#/', class: 'button quiet' }, '‹ Gallery'),
      element('h1', { class: 'title' }, 'Compare'),
      element('div', { class: 'spacer' }),
      trouble,
      both,
      element('button', { type: 'button', title: 'Show the keys (?)', onclick: () => keys.help() }, 'Keys'),
      themeSwitch(),
    ),
    element('div', { class: 'sides' }, ...sides.map((side) => side.figure)),
    tabs('compare', [
      { name: 'Metrics', panel: table },
      { name: 'Plots', panel: plots.root, shown: () => plots.show() },
      ...sides.map((side, i) => ({ name: `Parameters ${names[i]}`, panel: side.parameters.root })),
      { name: 'Layers', panel: layers.root, shown: layers.show },
    ]),
    time.root,
  );
  for (const side of sides) side.live.open();
  const lives = sides.map((side) => side.live);
  return {
    root,
    say,
    isAtRisk: () => lives.some(isAtRisk),
    mayLeave: () => mayLeave(lives),
    leave: () => {
      keys.destroy();
      plots.destroy();
      time.destroy();
      for (const side of sides) {
        side.live.close();
        side.stage.destroy();
      }
    },
  };
}
