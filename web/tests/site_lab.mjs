// SPDX-License-Identifier: Apache-2.0
// The static lab behind a plain server of files, as any host of static files is.
import { build } from 'esbuild';
import { createReadStream, existsSync, readFileSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { root } from './lab.mjs';

export const site = process.env.MICROSWARM_SITE ?? join(root, 'build/site');

const types = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.svg': 'image/svg+xml',
  '.wasm': 'application/wasm',
};

/** Serves the site: { url, stop() }. */
export async function serveSite() {
  const server = createServer((request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url, 'http://site').pathname));
    const file = join(site, path.endsWith('/') ? `${path}index.html` : path);
    if (!existsSync(file) || !statSync(file).isFile()) return response.writeHead(404).end();
    response.writeHead(200, { 'content-type': types[extname(file)] ?? 'application/json' });
    createReadStream(file).pipe(response);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { url: `http://127.0.0.1:${server.address().port}/`, stop: () => server.close() };
}

/** The module of the site in node, with the site's files. */
export async function loadModule() {
  const out = join(root, 'build/web/module.mjs');
  await build({
    entryPoints: [join(root, 'web/src/site/module.ts')],
    bundle: true,
    format: 'esm',
    outfile: out,
    logLevel: 'warning',
  });
  const { Module } = await import(out);
  const module = await Module.load(await WebAssembly.compile(readFileSync(join(site, 'lab.wasm'))), () => undefined);
  for (const [name, text] of Object.entries(JSON.parse(readFileSync(join(site, 'files.json'), 'utf8'))))
    module.files.set(name, new TextEncoder().encode(text));
  return module;
}
