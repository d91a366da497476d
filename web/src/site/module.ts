// SPDX-License-Identifier: Apache-2.0
import { type Files, wasi } from './wasi';

interface Exports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  buffer(size: number): number;
  result(): number;
  result_size(): number;
  open(session: number): number;
  join(session: number): void;
  ask(session: number): void;
  turn(session: number): number;
  close(session: number): void;
  make(session: number): number;
  run(): number;
}

/** The lab's sessions in WebAssembly; apps/site/lab.cpp says what each function does. */
export class Module {
  private constructor(
    readonly files: Files,
    private readonly of: Exports,
  ) {}

  /** `post` takes the messages of sessions, in CBOR. */
  static async load(module: WebAssembly.Module, post: (session: number, message: Uint8Array) => void): Promise<Module> {
    const files: Files = new Map();
    const { exports } = await WebAssembly.instantiate(module, {
      wasi_snapshot_preview1: wasi(files, () => of.memory),
      lab: {
        post: (session: number, at: number, size: number) =>
          post(session, new Uint8Array(of.memory.buffer, at, size).slice()),
      },
    });
    const of = exports as unknown as Exports;
    of._initialize();
    return new Module(files, of);
  }

  /** Opens a session of a file; throws an Error with the trouble. */
  open(session: number, asked: { file: string; settings?: string[] }): void {
    this.give(JSON.stringify(asked));
    if (this.of.open(session) === 0) throw new Error(this.taken());
  }

  join(session: number): void {
    this.of.join(session);
  }

  ask(session: number, request: object): void {
    this.give(JSON.stringify(request));
    this.of.ask(session);
  }

  /** Does what is due; the time until the next turn [ms], -1 for none. */
  turn(session: number): number {
    return this.of.turn(session);
  }

  close(session: number): void {
    this.of.close(session);
  }

  /** A file of a session. */
  make(session: number, name: string): Uint8Array {
    this.give(name);
    if (this.of.make(session) === 0) throw new Error(this.taken());
    return this.bytes();
  }

  /** The hash of the record of a whole run. */
  run(asked: { file: string; settings?: string[] }): string {
    this.give(JSON.stringify(asked));
    if (this.of.run() === 0) throw new Error(this.taken());
    return this.taken();
  }

  private give(text: string): void {
    const bytes = new TextEncoder().encode(text);
    const at = this.of.buffer(bytes.length);
    new Uint8Array(this.of.memory.buffer, at, bytes.length).set(bytes);
  }

  private taken(): string {
    return new TextDecoder().decode(this.bytes());
  }

  private bytes(): Uint8Array {
    return new Uint8Array(this.of.memory.buffer, this.of.result(), this.of.result_size()).slice();
  }
}
