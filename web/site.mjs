// SPDX-License-Identifier: Apache-2.0
// node site.mjs PROGRAM MODULE FOLDER: the static lab from the page, the program's listing, and the WebAssembly module.
import { build } from 'esbuild';
import { spawn } from 'node:child_process';
import { copyFileSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join, relative, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { bundled } from './bundled.mjs';
import { licences } from './licences.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const scenarios = join(here, '../scenarios');
const [program, module, out] = process.argv.slice(2).map((one) => resolve(one));

/** These modules of the page have another of their name in src/site. */
const replaced = ['connection', 'place', 'server_stream', 'uploads'];
const ofSite = {
  name: 'site',
  setup: ({ onResolve }) =>
    onResolve({ filter: new RegExp(`^\\./(${replaced.join('|')})$`) }, ({ path, importer }) =>
      dirname(importer) === join(here, 'src') ? { path: join(here, 'src/site', `${path}.ts`) } : undefined,
    ),
};

rmSync(out, { recursive: true, force: true });
mkdirSync(join(out, 'thumbnails'), { recursive: true });
await build({
  entryPoints: { app: join(here, 'src/app.ts'), worker: join(here, 'src/site/worker.ts') },
  ...bundled,
  outdir: out,
  plugins: [ofSite],
});
const page = readFileSync(join(here, 'src/index.html'), 'utf8');
writeFileSync(
  join(out, 'index.html'),
  page.replaceAll('"/app', '"app').replace('microswarm lab needs', 'The lab needs'),
);
copyFileSync(module, join(out, 'lab.wasm'));
// What the module contains: Debian's sources and headers, with the licences of their packages.
const linked =
  'libfmt-dev libyaml-cpp-dev nlohmann-json3-dev libhwy-dev libboost1.74-dev librandom123-dev libpolyclipping-dev libsleef-dev libhdf5-dev zlib1g-dev libc++-19-dev-wasm32 wasi-libc';
const ofDebian = linked
  .split(' ')
  .map((name) => `${name}:\n${readFileSync(`/usr/share/doc/${name}/copyright`, 'utf8')}`);
writeFileSync(join(out, 'licences.txt'), [licences(), ...ofDebian].join('\n\n'));

/** Texts of the shipped files by their paths. */
const texts = {};
for (const entry of readdirSync(scenarios, { recursive: true, withFileTypes: true }))
  if (/\.(yaml|geojson)$/.test(entry.name)) {
    const file = join(entry.parentPath ?? entry.path, entry.name);
    texts[`scenarios/${relative(scenarios, file)}`] = readFileSync(file, 'utf8');
  }
writeFileSync(join(out, 'files.json'), JSON.stringify(texts));

// The program lists the scenarios, draws them, and describes their keys, as for its own page.
const lab = spawn(program, ['lab', '--no-open', '--folder', scenarios], { cwd: out });
const address = await new Promise((resolve, reject) => {
  lab.stdout.once('data', (text) => resolve(new URL(String(text).split('\n')[0])));
  lab.once('exit', (code) => reject(new Error(`microswarm lab ended with ${code}`)));
});
const cookie = { cookie: (await fetch(address)).headers.get('set-cookie').split(';')[0] };
const get = async (path) => (await fetch(new URL(path, address), { headers: cookie })).text();
const listed = JSON.parse(await get('/api/scenarios')).scenarios;
const shipped = [];
for (const entry of listed) {
  const file = `scenarios/${relative(scenarios, entry.file)}`;
  if (!(file in texts) || shipped.some((one) => one.file === file)) continue;
  shipped.push({ ...entry, file });
  const picture = await get(`/api/thumbnail?file=${encodeURIComponent(entry.file)}`);
  writeFileSync(join(out, 'thumbnails', `${file.replaceAll('/', '-')}.svg`), picture);
}
writeFileSync(join(out, 'scenarios.json'), JSON.stringify({ scenarios: shipped }));
writeFileSync(join(out, 'schema.json'), await get('/api/schema'));
lab.kill();
