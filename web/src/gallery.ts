// SPDX-License-Identifier: Apache-2.0
import type { Page } from './page';
import { call } from './connection';
import { element } from './dom';
import { takeDrops } from './drops';
import { type Entry, cardText, heading } from './headings';
import { dropNote, thumbnail } from './place';
import { queueSection } from './queue';
import { themeSwitch } from './theme';
import { upload } from './uploads';

export interface Listing {
  scenarios: Entry[];
  open?: boolean;
  queue?: boolean;
}

interface OpenRun {
  session: number;
  name: string;
  t_s: number;
  watched: boolean;
  live: boolean;
}

/** Opens an experiment and shows its page. */
async function open(body: { file?: string; settings?: string[] }): Promise<void> {
  const { session, live } = await call<{ session: number; live: boolean }>('POST', '/api/sessions', body);
  location.hash = `#/${live ? 'rig' : 'session'}/${session}`;
}

/** Everything that can be opened. The program's own argument is opened at once, the first time. */
export async function galleryPage(): Promise<Page> {
  const listing = await call<Listing>('GET', '/api/scenarios');
  const trouble = element('p', { class: 'trouble', role: 'alert' });
  const attempt = (body: { file?: string }) => {
    trouble.replaceChildren();
    return open(body).then(
      () => true,
      (error: Error) => {
        trouble.replaceChildren(error.message);
        return false;
      },
    );
  };
  if (listing.open && !sessionStorage.getItem('opened')) {
    const isOpen = await attempt({});
    sessionStorage.setItem('opened', 'yes'); // after it: a page reloaded meanwhile opens it again
    if (isOpen) return { root: element('p', { class: 'doc' }, 'Opening …'), leave: () => undefined };
  }
  const take = async (file: File | undefined) => {
    if (!file) return;
    trouble.replaceChildren(`${file.name} is being read …`);
    try {
      const made = await upload(file);
      if (made.kind === 'photograph') location.hash = '#/photo';
      else await attempt({ file: made.file });
    } catch (error) {
      trouble.replaceChildren((error as Error).message);
    }
  };
  const chooser = element('input', {
    type: 'file',
    hidden: true,
    'aria-label': 'A file to open',
    accept: '.yaml,.yml,.h5,image/*,.tif,.tiff,.pgm,.ppm',
    onchange: () => void take(chooser.files?.[0]),
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
      element(
        'div',
        { class: 'cards' },
        ...entries.map((entry) => card(entry, () => void attempt({ file: entry.file }))),
      ),
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
    ...(sessions.length > 0 ? [openRuns(sessions)] : []),
    element('p', { class: 'doc' }, dropNote),
    ...sections,
  );
  const endDrops = takeDrops((files) => {
    void take(files[0]).then(() => {
      if (files.length > 1) trouble.append(` Only the first of ${files.length} files was read.`);
    });
  });
  return {
    root,
    leave: () => {
      queue?.leave();
      endDrops();
    },
  };
}

/** Runs that are open, to come back to. */
function openRuns(sessions: OpenRun[]): HTMLElement {
  const links = sessions.map(({ session, name, t_s, live, watched }) =>
    element(
      'a',
      { href: `#/${live ? 'rig' : 'session'}/${session}`, class: 'button' },
      `${name.slice(name.lastIndexOf('/') + 1)} · ${t_s.toFixed(1)} s${watched ? ' · shown by a page' : ''}`,
    ),
  );
  return element(
    'section',
    { class: 'open-runs' },
    element('h2', {}, 'Open runs'),
    element('div', { class: 'row' }, ...links),
  );
}

function card(entry: Entry, act: () => void): HTMLElement {
  const { name, text, trouble } = cardText(entry);
  const picture = element('img', {
    ...(trouble ? {} : { src: thumbnail(entry.file) }),
    ...(trouble ? { class: 'none' } : {}),
    alt: '',
    loading: 'lazy',
    onerror: () => picture.classList.add('none'),
  });
  return element(
    'button',
    {
      class: trouble ? 'card wrong' : 'card',
      type: 'button',
      title: trouble || text,
      'data-file': entry.file,
      'data-text': `${entry.file} ${name} ${text} ${trouble}`.toLowerCase(),
      onclick: act,
    },
    picture,
    element('strong', {}, name),
    element('span', trouble ? { class: 'issue' } : {}, trouble || text),
  );
}
