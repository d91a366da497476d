// SPDX-License-Identifier: Apache-2.0
import { refusal } from './headings';
import type { Photograph } from './photo_page';

interface Upload {
  file: string;
  kind: 'photograph' | 'scenario' | 'record';
  width_px: number;
  height_px: number;
}

/** Photograph of the page #/photo. */
export let photograph: Photograph | undefined;

/** Uploads a file; a photograph becomes that of #/photo. An error has the server's text. */
export async function upload(file: File): Promise<Upload> {
  const refused = refusal(file.name, file.size);
  if (refused) throw new Error(refused);
  const response = await fetch(`/api/uploads?name=${encodeURIComponent(file.name)}`, { method: 'POST', body: file });
  const json = await response.json();
  if (!response.ok) throw new Error(json.error ?? response.statusText);
  const made = json as Upload;
  if (made.kind === 'photograph') photograph = { ...made, name: file.name, address: URL.createObjectURL(file) };
  return made;
}
