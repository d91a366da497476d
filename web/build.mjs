// SPDX-License-Identifier: Apache-2.0
// node build.mjs FOLDER: the client as one script, one style sheet and one page.
import { build } from 'esbuild';
import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { bundled } from './bundled.mjs';
import { licences } from './licences.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2] ?? join(here, '../build/web');
mkdirSync(out, { recursive: true });

await build({
  entryPoints: [join(here, 'src/app.ts'), join(here, 'src/beat.ts')],
  ...bundled,
  outdir: out,
});
for (const name of ['app.js', 'app.css'])
  writeFileSync(join(out, `${name}.gz`), gzipSync(readFileSync(join(out, name)), { level: 9 }));
copyFileSync(join(here, 'src/index.html'), join(out, 'index.html'));
writeFileSync(join(out, 'licences.txt'), licences());
