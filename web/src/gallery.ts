// SPDX-License-Identifier: Apache-2.0
import type { Page } from './app';
import { call } from './connection';
import { element } from './dom';

interface Listing {
  scenarios: { file: string; name: string; description: string }[];
  open?: boolean;
}

/** Opens an experiment and goes to its page. */
async function open(body: { file?: string; settings?: string[] }): Promise<void> {
  const { session } = await call<{ session: number }>('POST', '/api/sessions', body);
  location.hash = `#/session/${session}`;
}

/** What can be opened. What the program was started with is opened at once, the first time. */
export async function galleryPage(): Promise<Page> {
  const listing = await call<Listing>('GET', '/api/scenarios');
  const trouble = element('p', { class: 'trouble', role: 'alert' });
  const attempt = (body: { file?: string }) =>
    open(body).catch((error: Error) => trouble.replaceChildren(error.message));
  const cards = listing.scenarios.map((entry) =>
    element(
      'button',
      { class: 'card', 'data-file': entry.file, onclick: () => void attempt({ file: entry.file }) },
      element('strong', {}, entry.name),
      element('span', {}, entry.description),
    ),
  );
  if (listing.open && !sessionStorage.getItem('opened')) {
    sessionStorage.setItem('opened', 'yes');
    void attempt({});
  }
  const root = element(
    'div',
    { class: 'gallery' },
    element('h1', {}, 'microswarm lab'),
    trouble,
    element('div', { class: 'cards' }, ...cards),
  );
  return { root, leave: () => undefined };
}
