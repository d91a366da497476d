// SPDX-License-Identifier: Apache-2.0
// What depends on where the page is: here static files. place.ts is the same beside a server.
import { element } from '../dom';
import type { Live } from '../live';
import { combine } from '../settings';
import { lab } from './lab';
import { pack, unpack } from './share';

export const downloads = ['record.h5', 'scenario.yaml'];
export const makesVideos = false;
export const makesBranches = false;
export const dropNote =
  'Drop a scenario or a record here; before a scenario the map that it names (GeoJSON, PGM, PBM, CSV, MovingAI). Nothing leaves this page, and it forgets everything when it is closed. Photographs, videos, sweeps and rigs need the installed program.';

export const keptNote =
  'It pauses and is kept under "Open runs" of the gallery until this page is closed; only its record keeps it for good.';

export function fileLink(session: number, name: string, label = name): HTMLElement {
  const link = element('a', { href: '#', download: name, class: 'button' }, label);
  link.addEventListener('click', (event) => {
    if (link.getAttribute('href') !== '#') return;
    event.preventDefault();
    void lab.call<Uint8Array>('make', session, name).then((bytes) => {
      const address = URL.createObjectURL(new Blob([bytes]));
      link.href = address;
      link.click();
      link.href = '#';
      setTimeout(() => URL.revokeObjectURL(address), 10_000);
    });
  });
  return link;
}

export function thumbnail(file: string): string {
  return `thumbnails/${file.replaceAll('/', '-')}.svg`;
}

/** A button that copies an address with the scenario and its changes. */
export function shareButtons(live: Live): HTMLElement[] {
  const said = element('output', { class: 'doc' });
  const share = async () => {
    const file = live.hello?.name ?? '';
    const settings = combine(live.hello?.settings ?? [], live.standing?.changes ?? []);
    const own = lab.own.some((one) => one.file === file) ? { text: await lab.call<string>('text', file) } : {};
    const address = new URL(`#/shared/${await pack({ file, settings, ...own })}`, location.href).href;
    await navigator.clipboard.writeText(address).then(
      () => (said.value = 'Copied: the scenario, its settings and the changes, from the start.'),
      () => (said.value = address),
    );
  };
  return [element('button', { type: 'button', class: 'share', onclick: () => void share() }, 'Copy link'), said];
}

export async function openShared(address: string): Promise<number | undefined> {
  const packed = /^#\/shared\/([\w-]+)$/.exec(address)?.[1];
  if (packed === undefined) return undefined;
  const { file, settings, text } = await unpack(packed);
  if (text !== undefined) await lab.call('keep', file, new TextEncoder().encode(text));
  return lab.open({ file, settings });
}
