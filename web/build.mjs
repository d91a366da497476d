// SPDX-License-Identifier: Apache-2.0
// node build.mjs FOLDER: the client as one script, one style sheet and one page.
import { build } from 'esbuild';
import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2] ?? join(here, '../build/web');
mkdirSync(out, { recursive: true });

await build({
  entryPoints: [join(here, 'src/app.ts'), join(here, 'src/beat.ts')],
  bundle: true,
  minify: true,
  format: 'esm',
  target: ['chrome110', 'firefox110'],
  legalComments: 'none',
  outdir: out,
  logLevel: 'warning',
});
for (const name of ['app.js', 'app.css'])
  writeFileSync(join(out, `${name}.gz`), gzipSync(readFileSync(join(out, name)), { level: 9 }));
copyFileSync(join(here, 'src/index.html'), join(out, 'index.html'));
writeFileSync(join(out, 'licences.txt'), licences());

/** The licences of the packages that the script contains. */
function licences() {
  const lock = JSON.parse(readFileSync(join(here, 'package-lock.json'), 'utf8'));
  return Object.entries(lock.packages)
    .filter(([path, entry]) => path.startsWith('node_modules/') && !entry.dev)
    .map(([path, entry]) => `${path.slice('node_modules/'.length)} ${entry.version}: ${licence(path)}`)
    .join('\n\n');
}

function licence(path) {
  for (const name of ['LICENSE', 'LICENSE.md', 'LICENSE.txt', 'LICENCE', 'license']) {
    try {
      return readFileSync(join(here, path, name), 'utf8').trim();
    } catch {
      // The next name.
    }
  }
  const { license, author } = JSON.parse(readFileSync(join(here, path, 'package.json'), 'utf8'));
  return `${license}. Copyright ${author?.name ?? author ?? 'the authors'}.`;
}
