// SPDX-License-Identifier: Apache-2.0
// What depends on where the page is: here beside a server. site/place.ts is the same for static files.
import { element } from './dom';
import type { Live } from './live';

/** Files of a session that can be downloaded. */
export const downloads = ['record.h5', 'scenario.yaml', 'frames.csv', 'events.csv'];
/** Whether drawings and videos of a run can be made. */
export const makesVideos = true;
/** Whether a run can branch from an earlier time. */
export const makesBranches = true;
/** Note under the gallery. */
export const dropNote = 'Drop a photograph of vessels, a scenario or a record here.';

/** Fate of a run whose page is left. */
export const keptNote =
  'It pauses and is kept for 30 minutes under "Open runs" of the gallery, unless others need its place; only its record keeps it for good.';

/** A link that downloads a file of a session. */
export function fileLink(session: number, name: string, label = name): HTMLElement {
  return element('a', { href: `/api/sessions/${session}/${name}`, download: name, class: 'button' }, label);
}

/** Address of the picture of a scenario or record. */
export function thumbnail(file: string): string {
  return `/api/thumbnail?file=${encodeURIComponent(file)}`;
}

/** Buttons that share a run. */
export function shareButtons(_: Live): HTMLElement[] {
  return [];
}

/** Opens what a shared address names; its session, or undefined if the address names none. */
export function openShared(_: string): Promise<number | undefined> {
  return Promise.resolve(undefined);
}
