// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));

/** The licences of the packages that the script contains. */
export function licences() {
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
