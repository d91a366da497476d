// SPDX-License-Identifier: Apache-2.0
import './app.css';
import './picture.css';
import { comparePage } from './compare_page';
import { element } from './dom';
import { takeDrops } from './drops';
import { galleryPage } from './gallery';
import { openFiles } from './opening';
import type { Page } from './page';
import { photoPage } from './photo_page';
import { openShared } from './place';
import { playerPage } from './player';
import { sessionPage } from './session_page';
import { startTheme } from './theme';
import { photograph } from './uploads';

let page: Page | undefined;

const run = document.getElementById('run'); // in a file that plays itself

/** The run in the page, or the page of the current address: #/session/7 or #/session/7/present, #/rig/7, #/compare/7/8, else the gallery. */
async function named(): Promise<Page> {
  if (run) return playerPage(run.textContent ?? '');
  const session = /^#\/session\/(\d+)(?:\/present)?$/.exec(location.hash);
  if (session) return sessionPage(Number(session[1]));
  const rig = /^#\/rig\/(\d+)$/.exec(location.hash);
  if (rig) return sessionPage(Number(rig[1]), true);
  if (location.hash === '#/photo' && photograph) return photoPage(photograph);
  const pair = /^#\/compare\/(\d+)\/(\d+)$/.exec(location.hash);
  if (pair) return comparePage([Number(pair[1]), Number(pair[2])]);
  const shared = await openShared(location.hash);
  if (shared !== undefined) {
    history.replaceState(null, '', `#/session/${shared}`);
    return sessionPage(shared);
  }
  return galleryPage();
}

let shown = ''; // address of the page
let routes = 0; // number of changes of the page
let isAsking = false; // whether the page may be left

async function route(): Promise<void> {
  const wanted = location.hash;
  if (wanted === shown && page) return; // it came back after a person stayed
  if (page?.mayLeave && page.isAtRisk?.()) {
    history.replaceState(null, '', shown);
    if (isAsking) return; // one question at a time
    isAsking = true;
    const goes = await page.mayLeave().finally(() => (isAsking = false));
    if (!goes) return;
    history.pushState(null, '', wanted);
  }
  const own = ++routes;
  page?.leave();
  page = undefined;
  shown = wanted;
  const place = document.getElementById('page');
  try {
    const made = await named();
    if (own !== routes) return made.leave(); // another address came meanwhile
    page = made;
    place?.replaceChildren(made.root);
  } catch (error) {
    if (own !== routes) return;
    const why = element('p', { class: 'trouble', role: 'alert' }, (error as Error).message);
    place?.replaceChildren(
      element(
        'div',
        { class: 'fault' },
        ...(run ? [] : [element('a', { href: '#/', class: 'button quiet' }, '‹ Gallery')]),
        element('h1', {}, 'Nothing to show'),
        why,
      ),
    );
  }
}

window.addEventListener('beforeunload', (event) => {
  if (page?.isAtRisk?.()) event.preventDefault();
});
if (!run)
  takeDrops((files) => {
    const say = page?.say ?? (() => undefined);
    const kept = page?.keepsFiles?.() ?? '';
    if (kept) say(kept);
    else if (page) void openFiles(files, say);
  });
startTheme();
window.addEventListener('hashchange', () => void route());
if (!run) history.replaceState(null, '', location.pathname + location.hash); // without the token
void route();
