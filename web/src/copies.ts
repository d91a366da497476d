// SPDX-License-Identifier: Apache-2.0
import { call } from './connection';
import type { Live } from './live';
import type { Parameters } from './parameters';
import { said } from './protocol';

const outside = 'no such file in the folders of this lab'; // the server's refusal

/** Opens the experiment of a session a second time, with these settings; the number of the new session. */
export async function openAgain(live: Live, settings: string[]): Promise<number> {
  const open = (file: object) => call<{ session: number }>('POST', '/api/sessions', { ...file, settings });
  const photo = live.hello?.photo;
  const beneath = photo ? { photo: photo.file, um_per_px: photo.um_per_px } : {};
  try {
    return (await open({ file: live.hello?.name, ...beneath })).session;
  } catch (error) {
    if (!(error as Error).message.includes(outside)) throw error;
  }
  // Only the experiment of the command line may be outside of the folders.
  const { session } = await open({});
  const nameOf = async (one: number) => (await call<{ name: string }>('GET', `/api/sessions/${one}`)).name;
  const [name, own] = await Promise.all([nameOf(session), nameOf(live.session)]);
  if (name === own) return session;
  await call('DELETE', `/api/sessions/${session}`);
  throw new Error(`${own} is no longer in the folders of this lab.`);
}

/** Opens the run of a session again, repeated up to the frame that it shows; from there on it has these changes. */
export async function openBranch(live: Live, changes: string[]): Promise<number> {
  const { settings } = live.hello ?? { settings: [] };
  const body = { branch: live.session, frame: live.standing?.frame, settings, changes };
  return (await call<{ session: number }>('POST', '/api/sessions', body)).session;
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
