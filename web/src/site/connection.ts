// SPDX-License-Identifier: Apache-2.0
// The lab's requests, answered by static files and by the worker.
import type { Listing } from '../gallery';
import { lab } from './lab';

export type { Connect, Connection } from '../connection';

async function fetched<T>(name: string): Promise<T> {
  const response = await fetch(name);
  if (!response.ok) throw new Error(`${name}: ${response.statusText}`);
  return (await response.json()) as T;
}

/** Answers a request as the server would. */
export async function call<T>(method: 'GET' | 'POST' | 'DELETE', path: string, body?: unknown): Promise<T> {
  return (await answer(method, path, body)) as T;
}

async function answer(method: string, path: string, body: unknown): Promise<unknown> {
  if (path === '/api/scenarios') {
    const listing = await fetched<Listing>('scenarios.json');
    return { scenarios: [...listing.scenarios, ...lab.own], lab: 0 };
  }
  if (path === '/api/schema') return fetched('schema.json');
  if (path === '/api/sessions' && method === 'GET') return { sessions: lab.sessions() };
  if (path === '/api/sessions')
    return { session: await lab.open(body as { file: string; settings?: string[] }), live: false };
  const session = Number(/^\/api\/sessions\/(\d+)$/.exec(path)?.[1]);
  if (method === 'DELETE') return lab.close(session);
  const open = lab.sessions().find((one) => one.session === session);
  if (open) return open;
  throw new Error(`The static lab does not answer ${method} ${path}.`);
}

/** Throws an Error unless the session is open. */
export async function requireOpen(session: number): Promise<void> {
  if (!lab.sessions().some((one) => one.session === session))
    throw new Error('This run is closed: a page of the static lab keeps its runs only until it is loaded again.');
}
