// SPDX-License-Identifier: Apache-2.0
// The worker of the static lab: steps the sessions of the module, and posts what a server would send.
import { Module } from './module';

const scope = self as unknown as {
  postMessage(message: unknown, transfer: Transferable[]): void;
  onmessage: (event: MessageEvent<{ id: number; name: keyof typeof functions; given: never[] }>) => void;
};

const timers = new Map<number, number>();

/** Lets a session do what is due, and calls itself when more is. */
function turn(module: Module, session: number): void {
  clearTimeout(timers.get(session));
  const wait = module.turn(session);
  if (wait >= 0)
    timers.set(
      session,
      self.setTimeout(() => turn(module, session), wait),
    );
}

/** The module with the files of the site. */
async function load(): Promise<Module> {
  const [code, files] = await Promise.all([fetch('lab.wasm'), fetch('files.json')]);
  const module = await Module.load(await WebAssembly.compile(await code.arrayBuffer()), (session, message) =>
    scope.postMessage({ session, message }, [message.buffer]),
  );
  for (const [name, text] of Object.entries((await files.json()) as { [name: string]: string }))
    module.files.set(name, new TextEncoder().encode(text));
  return module;
}
const loaded = load();

const functions = {
  /** Keeps a file. */
  keep: (module: Module, name: string, bytes: Uint8Array) => void module.files.set(name, bytes),
  open: (module: Module, session: number, asked: { file: string; settings?: string[] }) => module.open(session, asked),
  join: (module: Module, session: number) => {
    module.join(session);
    turn(module, session);
  },
  ask: (module: Module, session: number, request: object) => {
    module.ask(session, request);
    turn(module, session);
  },
  close: (module: Module, session: number) => {
    clearTimeout(timers.get(session));
    module.close(session);
  },
  make: (module: Module, session: number, name: string) => module.make(session, name),
  run: (module: Module, asked: { file: string; settings?: string[] }) => module.run(asked),
  text: (module: Module, name: string) => new TextDecoder().decode(module.files.get(name)),
};

scope.onmessage = async ({ data: { id, name, given } }) => {
  try {
    const module = await loaded;
    scope.postMessage(
      { id, value: (functions[name] as (of: Module, ...given: unknown[]) => unknown)(module, ...given) },
      [],
    );
  } catch (error) {
    scope.postMessage({ id, error: (error as Error).message }, []);
  }
};
