// SPDX-License-Identifier: Apache-2.0
// The page's end of the worker that runs the sessions.
import type { Entry } from '../headings';
import type { OpenRun } from '../open_runs';

export interface OpenRequest {
  file: string;
  settings?: string[];
}

type Posted = { id: number; value?: unknown; error?: string } | { session: number; message: Uint8Array };

/** The worker, its sessions, and the files that were opened. */
class Lab {
  /** Cards of files that were opened. */
  readonly own: Entry[] = [];
  private readonly worker = new Worker('worker.js', { type: 'module' });
  private readonly waiting = new Map<number, (answer: { value?: unknown; error?: string }) => void>();
  private readonly listeners = new Map<number, (message: Uint8Array) => void>();
  private readonly open_ = new Map<number, OpenRun>();
  private next = 1;
  private newest = 0;

  constructor() {
    this.worker.onmessage = ({ data }: MessageEvent<Posted>) => {
      if ('session' in data) return this.listeners.get(data.session)?.(data.message);
      this.waiting.get(data.id)?.(data);
      this.waiting.delete(data.id);
    };
    this.worker.onerror = (event) => {
      for (const answer of this.waiting.values()) answer({ error: `The lab's worker failed: ${event.message}` });
      this.waiting.clear();
    };
  }

  /** Calls a function of the worker. */
  call<T>(name: string, ...given: unknown[]): Promise<T> {
    const id = this.next++;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, ({ value, error }) =>
        error === undefined ? resolve(value as T) : reject(new Error(error)),
      );
      this.worker.postMessage({ id, name, given });
    });
  }

  /** Adds the card of a file that was opened. */
  add(file: string): void {
    if (this.own.some((one) => one.file === file)) return;
    const name = file.slice(file.lastIndexOf('/') + 1).replace(/\.\w+$/, '');
    const record = file.endsWith('.h5');
    this.own.push({ file, name, description: '', record, navigator: '', outcome: '', written: '', trouble: '' });
  }

  /** Opens a session; its number. */
  async open(asked: OpenRequest): Promise<number> {
    const session = ++this.newest;
    await this.call('open', session, asked);
    this.open_.set(session, { session, name: asked.file, t_s: 0, watched: false, changed: false, live: false });
    return session;
  }

  async close(session: number): Promise<void> {
    this.open_.delete(session);
    await this.call('close', session);
  }

  sessions(): OpenRun[] {
    return [...this.open_.values()];
  }

  /** Takes the messages of a session from its hello on, until the returned function is called. */
  join(session: number, take: (message: Uint8Array) => void): () => void {
    this.listeners.set(session, take);
    void this.call('join', session);
    return () => {
      this.listeners.delete(session);
      if (this.open_.has(session)) void this.call('ask', session, { do: 'pause' });
    };
  }
}

export const lab = new Lab();
