// SPDX-License-Identifier: Apache-2.0
import type { Page } from './page';
import { call } from './connection';
import { element } from './dom';
import { type Entry, cardText, heading } from './headings';
import { open, openFiles } from './opening';
import { type OpenRun, openRuns } from './open_runs';
import { dropNote, thumbnail } from './place';
import { queueSection } from './queue';
import { themeSwitch } from './theme';

export interface Listing {
  scenarios: Entry[];
  lab: number;
  open?: boolean;
  queue?: boolean;
}

/** Everything that can be opened. The program's own argument is opened at once, the first time. */
export async function galleryPage(): Promise<Page> {
  const listing = await call<Listing>('GET', '/api/scenarios');
  const trouble = element('p', { class: 'trouble', role: 'alert' });
  const say = (text: string) => trouble.replaceChildren(text);
  const attempt = (body: { file?: string }) => {
    say('');
    return open(body).then(
      () => true,
      (error: Error) => {
        say(error.message);
        return false;
      },
    );
  };
  if (listing.open && sessionStorage.getItem('opened') !== String(listing.lab)) {
    const isOpen = await attempt({});
    sessionStorage.setItem('opened', String(listing.lab)); // after it: a page reloaded meanwhile opens it again
    if (isOpen) return { root: element('p', { class: 'doc' }, 'Opening …'), leave: () => undefined };
  }
  const chooser = element('input', {
    type: 'file',
    hidden: true,
    'aria-label': 'A file to open',
    accept: '.yaml,.yml,.h5,image/*,.tif,.tiff,.pgm,.ppm',
    onchange: () => void openFiles([...(chooser.files ?? [])], say),
  });
  const folders = new Map<string, Entry[]>();
  for (const entry of listing.scenarios) {
    const folder = entry.file.slice(0, Math.max(0, entry.file.lastIndexOf('/')));
    folders.set(folder, [...(folders.get(folder) ?? []), entry]);
  }
  const sections = [...folders].map(([folder, entries]) =>
    element(
      'section',
      {},
      element('h2', {}, heading(folder)),
      element('div', { class: 'cards' }, ...entries.map((entry) => card(entry, () => attempt({ file: entry.file })))),
    ),
  );
  const none = element('p', { class: 'doc', hidden: true }, 'No experiment matches.');
  const find = () => {
    const wanted = search.value.toLowerCase().split(/\s+/);
    for (const section of sections) {
      for (const one of section.querySelectorAll<HTMLElement>('.card'))
        one.hidden = !wanted.every((word) => (one.dataset['text'] ?? '').includes(word));
      section.hidden = section.querySelector('.card:not([hidden])') === null;
    }
    none.hidden = sections.some((section) => !section.hidden);
  };
  const search = element('input', {
    type: 'search',
    class: 'search',
    placeholder: 'Find an experiment',
    'aria-label': 'Find an experiment',
    oninput: find,
  });
  document.title = 'microswarm lab';
  const again = listing.open
    ? [
        element(
          'button',
          { type: 'button', onclick: () => void attempt({}) },
          'Open the experiment of the command line',
        ),
      ]
    : [];
  const { sessions } = await call<{ sessions: OpenRun[] }>('GET', '/api/sessions');
  const queue = listing.queue ? queueSection() : undefined;
  const root = element(
    'div',
    { class: 'gallery' },
    element(
      'header',
      { class: 'top' },
      element('h1', {}, 'microswarm lab'),
      search,
      ...again,
      element('button', { type: 'button', class: 'choose', onclick: () => chooser.click() }, 'Open a file …'),
      chooser,
      themeSwitch(),
    ),
    trouble,
    none,
    ...(queue ? [queue.root] : []),
    ...(sessions.length > 0 ? [openRuns(sessions, say)] : []),
    element('p', { class: 'doc' }, dropNote),
    ...sections,
  );
  return {
    root,
    say,
    leave: () => queue?.leave(),
  };
}

function card(entry: Entry, act: () => Promise<unknown>): HTMLElement {
  const { name, text, trouble } = cardText(entry);
  const picture = element('img', {
    ...(trouble ? {} : { src: thumbnail(entry.file) }),
    ...(trouble ? { class: 'none' } : {}),
    alt: '',
    loading: 'lazy',
    onerror: () => picture.classList.add('none'),
  });
  const root = element(
    'button',
    {
      class: trouble ? 'card wrong' : 'card',
      type: 'button',
      title: trouble || text,
      'data-file': entry.file,
      'data-text': `${entry.file} ${name} ${text} ${trouble}`.toLowerCase(),
      onclick: () => {
        root.disabled = true; // it takes a while, and a second click would open it twice
        root.setAttribute('aria-busy', 'true');
        void act().finally(() => {
          root.disabled = false;
          root.removeAttribute('aria-busy');
        });
      },
    },
    picture,
    element('strong', {}, name),
    element('span', trouble ? { class: 'issue' } : {}, trouble || text),
  );
  return root;
}
