// SPDX-License-Identifier: Apache-2.0
import { call } from './connection';
import { upload } from './uploads';

/** Opens an experiment and shows its page. */
export async function open(body: { file?: string; settings?: string[] }): Promise<void> {
  const { session, live } = await call<{ session: number; live: boolean }>('POST', '/api/sessions', body);
  location.hash = `#/${live ? 'rig' : 'session'}/${session}`;
}

/** Uploads files that were chosen or dropped, of which the first is shown; `say` gets how far it is, or what is wrong. */
export async function openFiles(files: File[], say: (text: string, isTrouble?: boolean) => void): Promise<void> {
  const [file] = files;
  if (!file) return;
  const rest = files.length > 1 ? `Only the first of ${files.length} files was read.` : '';
  say(`${file.name} is being read …`, false);
  try {
    const made = await upload(file);
    if (made.kind === 'photograph') location.hash = '#/photo';
    else await open({ file: made.file });
    say(rest);
  } catch (error) {
    say(`${(error as Error).message} ${rest}`.trim());
  }
}
