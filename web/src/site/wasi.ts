// SPDX-License-Identifier: Apache-2.0
// What wasi-libc asks of a system, as far as the module needs it: files in memory, a clock, a stream for errors.

const success = 0;
const badDescriptor = 8;
const noFile = 44;
const unsupported = 58;

const root = 3; // descriptor of the folder /
const kindFolder = 3;
const kindFile = 4;

interface Open {
  bytes: Uint8Array;
  at: number;
}

/** Files by their path without the first slash. */
export type Files = Map<string, Uint8Array>;

/** The functions that the module imports from `wasi_snapshot_preview1`. */
export function wasi(files: Files, memory: () => WebAssembly.Memory): WebAssembly.ModuleImports {
  const open = new Map<number, Open>();
  let next = root + 1;
  const view = () => new DataView(memory().buffer);
  const bytesAt = (at: number, size: number) => new Uint8Array(memory().buffer, at, size);
  const textAt = (at: number, size: number) => new TextDecoder().decode(bytesAt(at, size).slice());
  const named = (at: number, size: number) => files.get(normal(textAt(at, size)));

  /** The pieces of memory that a list of pointers and sizes names. */
  const pieces = (list: number, count: number) =>
    Array.from({ length: count }, (_, i) =>
      bytesAt(view().getUint32(list + 8 * i, true), view().getUint32(list + 8 * i + 4, true)),
    );
  const writeStatus = (at: number, kind: number, size: number) => {
    bytesAt(at, 64).fill(0);
    view().setUint8(at + 16, kind);
    view().setBigUint64(at + 32, BigInt(size), true);
  };

  const known: { [name: string]: (...given: number[]) => number } = {
    fd_prestat_get: (fd, at) => {
      if (fd !== root) return badDescriptor;
      view().setUint32(at as number, 0, true);
      view().setUint32((at as number) + 4, 1, true);
      return success;
    },
    fd_prestat_dir_name: (_, at) => {
      bytesAt(at as number, 1)[0] = '/'.charCodeAt(0);
      return success;
    },
    path_open: (_fd, _look, path, size, _open, _rights, _inherited, _flags, at) => {
      const bytes = named(path as number, size as number);
      if (!bytes) return noFile;
      open.set(next, { bytes, at: 0 });
      view().setUint32(at as number, next++, true);
      return success;
    },
    path_filestat_get: (_fd, _flags, path, size, at) => {
      const bytes = named(path as number, size as number);
      if (!bytes) return noFile;
      writeStatus(at as number, kindFile, bytes.length);
      return success;
    },
    fd_filestat_get: (fd, at) => {
      const file = open.get(fd as number);
      if (!file) return badDescriptor;
      writeStatus(at as number, kindFile, file.bytes.length);
      return success;
    },
    fd_fdstat_get: (fd, at) => {
      bytesAt(at as number, 24).fill(0);
      view().setUint8(at as number, fd === root ? kindFolder : kindFile);
      view().setBigUint64((at as number) + 8, ~0n & 0xffff_ffff_ffff_ffffn, true);
      view().setBigUint64((at as number) + 16, 0xffff_ffff_ffff_ffffn, true);
      return success;
    },
    fd_read: (fd, list, count, at) => {
      const file = open.get(fd as number);
      if (!file) return badDescriptor;
      let read = 0;
      for (const piece of pieces(list as number, count as number)) {
        const part = file.bytes.subarray(file.at, file.at + piece.length);
        piece.set(part);
        file.at += part.length;
        read += part.length;
      }
      view().setUint32(at as number, read, true);
      return success;
    },
    fd_write: (_fd, list, count, at) => {
      const texts = pieces(list as number, count as number).map((piece) => new TextDecoder().decode(piece.slice()));
      const size = pieces(list as number, count as number).reduce((sum, piece) => sum + piece.length, 0);
      console.error(texts.join('').trimEnd());
      view().setUint32(at as number, size, true);
      return success;
    },
    fd_close: (fd) => (open.delete(fd as number) ? success : badDescriptor),
    environ_sizes_get: (count, size) => {
      view().setUint32(count as number, 0, true);
      view().setUint32(size as number, 0, true);
      return success;
    },
    environ_get: () => success,
    proc_exit: (code) => {
      throw new Error(`The module has ended with code ${code}.`);
    },
  };
  const others: { [name: string]: (...given: never[]) => number } = {
    clock_time_get: (_id: number, _precision: bigint, at: number) => {
      view().setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
      return success;
    },
    fd_seek: () => unsupported,
  };
  return new Proxy({ ...known, ...others } as WebAssembly.ModuleImports, {
    get: (all, name) => all[name as string] ?? (() => unsupported),
  });
}

/** A path without "." and "..", and without the first slash. */
function normal(path: string): string {
  const parts: string[] = [];
  for (const part of path.split('/')) {
    if (part === '..') parts.pop();
    else if (part !== '' && part !== '.') parts.push(part);
  }
  return parts.join('/');
}
