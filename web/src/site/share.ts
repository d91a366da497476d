// SPDX-License-Identifier: Apache-2.0

/** Content of a shared address: a scenario of the site, or one with its text, and its settings. */
export interface Shared {
  file: string;
  settings: string[];
  text?: string;
}

async function piped(bytes: Uint8Array, through: TransformStream): Promise<Uint8Array> {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(through)).arrayBuffer());
}

/** As text for an address. */
export async function pack(shared: Shared): Promise<string> {
  const bytes = await piped(new TextEncoder().encode(JSON.stringify(shared)), new CompressionStream('deflate-raw'));
  return btoa(String.fromCharCode(...bytes))
    .replaceAll('+', '-')
    .replaceAll('/', '_')
    .replaceAll('=', '');
}

/** Reads it back; throws an Error if the address is damaged. */
export async function unpack(packed: string): Promise<Shared> {
  try {
    const bytes = Uint8Array.from(atob(packed.replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0));
    const shared = JSON.parse(
      new TextDecoder().decode(await piped(bytes, new DecompressionStream('deflate-raw'))),
    ) as Shared;
    const isSound = typeof shared.file === 'string' && Array.isArray(shared.settings);
    if (isSound) return shared;
  } catch {
    // Said below.
  }
  throw new Error('This link is damaged: a part of it is missing.');
}
