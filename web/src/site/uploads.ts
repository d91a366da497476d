// SPDX-License-Identifier: Apache-2.0
import type { Photograph } from '../photo_page';
import { refusal } from '../headings';
import { lab } from './lab';

/** There is no photograph page in the static lab. */
export const photograph: Photograph | undefined = undefined;

const opened = /\.(ya?ml|h5)$/i;
const pictures = /\.(png|jpe?g|bmp|tiff?|gif|svg)$/i;

/** Takes a file: a scenario or a record is opened, everything else is kept for the scenarios that name it. */
export async function upload(file: File): Promise<{ file: string; kind: 'scenario' }> {
  const refused = refusal(file.name, file.size);
  if (refused) throw new Error(refused);
  if (pictures.test(file.name))
    throw new Error(
      `${file.name}: the static lab reads pictures as PGM, PPM or PBM only, draws no SVG and finds no vessels in photographs; the installed program does.`,
    );
  const name = `own/${file.name}`;
  await lab.call('keep', name, new Uint8Array(await file.arrayBuffer()));
  if (!opened.test(file.name)) throw new Error(`${file.name} is kept: open a scenario that names it as its map.`);
  lab.add(name);
  return { file: name, kind: 'scenario' };
}
