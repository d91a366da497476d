// SPDX-License-Identifier: Apache-2.0
import { call } from './connection';
import { csvOf } from './csv';
import { element } from './dom';
import type { Live } from './live';
import { numberEntry } from './number_entry';
import { makesVideos } from './place';
import { showOutcome, showProgress } from './progress';
import type { Scene } from './scene/scene';

const speeds = [1, 2, 4, 8, 16, 32];

/** Export of the view as files: picture, numbers of the plots, and from a server vector drawing and video. */
export function exportPanel(live: Live, scene: Scene): HTMLElement {
  const said = element('output', { class: 'doc' });
  const speed = element('select', { 'aria-label': 'Speed of the video', title: 'Seconds of the run per second' });
  for (const one of speeds) speed.append(element('option', { value: String(one) }, `×${one}`));
  speed.value = '4';
  const width = element('select', { 'aria-label': 'Width of the video' });
  for (const one of [640, 1280, 1920]) width.append(element('option', { value: String(one) }, `${one} px`));
  width.value = '1280';
  const time = (label: string, title: string) =>
    numberEntry({ placeholder: label, 'aria-label': label, title }, undefined, (trouble) => (said.value = trouble));
  const from = time('from s', 'First time of the video [s]; empty: the start');
  const to = time('to s', 'Last time of the video [s]; empty: the newest frame');
  const video = () =>
    new URLSearchParams({
      from: String(from.get() ?? ''),
      to: String(to.get() ?? ''),
      speed: speed.value,
      width: width.value,
    });
  const path = `/api/sessions/${live.session}`;
  let cancel: AbortController | undefined;
  const buttons: HTMLButtonElement[] = [];

  /** Says how far the export is. */
  const tell = async (name: string) => {
    const { share } = await call<{ share: number | null }>('GET', `${path}/export`).catch(() => ({ share: null }));
    if (!stop.hidden && share !== null) showProgress(said, `Making ${name}: ${Math.floor(100 * share)} %`);
  };
  const act = (label: string, name: string, title: string, make: (signal: AbortSignal) => Promise<Blob>) => {
    const button = element('button', { type: 'button', title, onclick: () => void run() }, label);
    buttons.push(button);
    const run = async () => {
      cancel = new AbortController();
      for (const one of buttons) one.disabled = true; // one export at a time
      stop.hidden = false;
      showOutcome(said, `Making ${name} …`);
      const asks = live.isServed ? window.setInterval(() => void tell(name), 700) : undefined;
      try {
        save(await make(cancel.signal), name);
        showOutcome(said, `${name} is made.`);
      } catch (error) {
        showOutcome(said, (error as Error).name === 'AbortError' ? 'Cancelled.' : (error as Error).message);
      }
      window.clearInterval(asks);
      stop.hidden = true;
      for (const one of buttons) one.disabled = false;
    };
    return button;
  };
  const isDrawn = live.isServed && makesVideos;
  const drawing = () =>
    act('SVG', 'picture.svg', 'The run at this time, as vector graphics', (signal) =>
      fetched(`${path}/picture.svg?t=${live.shown}`, signal),
    );
  const videos = () => [
    element(
      'div',
      { class: 'row' },
      act('MP4', 'run.mp4', 'A video of the run so far', (signal) => fetched(`${path}/run.mp4?${video()}`, signal)),
      act('GIF', 'run.gif', 'The same as an animated GIF', (signal) => fetched(`${path}/run.gif?${video()}`, signal)),
      speed,
      width,
    ),
    element('div', { class: 'row' }, from.root, to.root),
  ];
  const stop = element('button', { type: 'button', hidden: true, onclick: () => cancel?.abort() }, 'Cancel');
  return element(
    'div',
    { class: 'exports' },
    element(
      'div',
      { class: 'row' },
      act('PNG', 'picture.png', 'The scene as shown', () => scene.picture()),
      ...(isDrawn ? [drawing()] : []),
      act('CSV', 'plots.csv', 'The numbers of the plots', () =>
        Promise.resolve(new Blob([csvOf(live.history.columns, live.hello?.states ?? [])], { type: 'text/csv' })),
      ),
    ),
    ...(isDrawn ? videos() : []),
    element('div', { class: 'row' }, stop, said),
  );
}

async function fetched(address: string, signal: AbortSignal): Promise<Blob> {
  const response = await fetch(address, { signal });
  if (!response.ok) throw new Error((await response.json()).error ?? response.statusText);
  return response.blob();
}

function save(blob: Blob, name: string): void {
  const address = URL.createObjectURL(blob);
  element('a', { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
