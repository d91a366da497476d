// SPDX-License-Identifier: Apache-2.0
import { call } from './connection';
import type { Live } from './live';
import type { Parameters } from './parameters';
import { said } from './protocol';

/** Opens the experiment of a session a second time, with these settings; the number of the new session. */
export async function openAgain(live: Live, settings: string[]): Promise<number> {
  const open = (file: object) => call<{ session: number }>('POST', '/api/sessions', { ...file, settings });
  const photo = live.hello?.photo;
  const beneath = photo ? { photo: photo.file, um_per_px: photo.um_per_px } : {};
  // What the program was started with may be outside of the folders.
  const { session } = await open({ file: live.hello?.name, ...beneath }).catch(() => open({}));
  return session;
}

/** Opens the experiment of a session a second time beside it; both start at 0. */
export async function openCopy(live: Live, parameters: Parameters): Promise<void> {
  const settings = parameters.settings();
  if (!live.hello?.playback) {
    const answer = await parameters.restart();
    if (answer.issues.length > 0) throw new Error(said(answer));
  }
  location.hash = `#/compare/${live.session}/${await openAgain(live, settings)}`;
}
