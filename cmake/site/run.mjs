// SPDX-License-Identifier: Apache-2.0
// node run.mjs PROGRAM.wasm FILE: runs a program for WASI and writes what it prints into the file.
import { openSync, readFileSync } from 'node:fs';
import { WASI } from 'node:wasi';

const [program, file] = process.argv.slice(2);
const wasi = new WASI({ version: 'preview1', args: [program], returnOnExit: true, stdout: openSync(file, 'w') });
const { instance } = await WebAssembly.instantiate(readFileSync(program), wasi.getImportObject());
process.exit(wasi.start(instance));
