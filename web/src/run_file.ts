// SPDX-License-Identifier: Apache-2.0
// A run within a page, as `microswarm report --page` writes it: the messages of the stream, packed.
import { decode } from 'cborg';
import type { Bytes } from './protocol';

/** A message, and the frame from which on it holds. */
export type Since = [number, Bytes];

/** Messages of a run as they are in a stream. */
export interface RunFile {
  hello: Bytes;
  clearance: Bytes;
  rows: Bytes;
  standing: Bytes;
  frames: Bytes[];
  scenario: Since[];
  plan: Since[];
  aggregation: Since[];
  every: number; // such frames of the record are kept
  version: string; // of the program that made the record
  hash: string; // of the record
}

/** Reads a run of base64, gzip and CBOR. */
export async function readRun(text: string): Promise<RunFile> {
  const packed = Uint8Array.from(atob(text.trim()), (one) => one.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  return decode(new Uint8Array(await new Response(stream).arrayBuffer())) as RunFile;
}

/** The newest of the messages that holds at a frame. */
export function heldAt(list: Since[], frame: number): Bytes | undefined {
  let found: Bytes | undefined;
  for (const [from, message] of list) {
    if (from > frame) break;
    found = message;
  }
  return found;
}
