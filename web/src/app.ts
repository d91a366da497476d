// SPDX-License-Identifier: Apache-2.0
import './app.css';
import { comparePage } from './compare_page';
import { element } from './dom';
import { galleryPage } from './gallery';
import type { Page } from './page';
import { photoPage } from './photo_page';
import { sessionPage } from './session_page';
import { startTheme } from './theme';
import { photograph } from './uploads';

let page: Page | undefined;

/** The page of the current address: #/session/7, #/rig/7, #/compare/7/8, else the gallery. */
function named(): Promise<Page> {
  const session = /^#\/session\/(\d+)$/.exec(location.hash);
  if (session) return sessionPage(Number(session[1]));
  const rig = /^#\/rig\/(\d+)$/.exec(location.hash);
  if (rig) return sessionPage(Number(rig[1]), true);
  if (location.hash === '#/photo' && photograph) return photoPage(photograph);
  const pair = /^#\/compare\/(\d+)\/(\d+)$/.exec(location.hash);
  if (pair) return comparePage([Number(pair[1]), Number(pair[2])]);
  return galleryPage();
}

let shown = ''; // address of the page

async function route(): Promise<void> {
  const wanted = location.hash;
  if (wanted === shown && page) return; // it came back after a person stayed
  if (page?.mayLeave && page.isAtRisk?.()) {
    history.replaceState(null, '', shown);
    if (!(await page.mayLeave())) return;
    history.pushState(null, '', wanted);
  }
  page?.leave();
  page = undefined;
  shown = wanted;
  const place = document.getElementById('page');
  try {
    const made = await named();
    if (location.hash !== wanted) return made.leave();
    page = made;
    place?.replaceChildren(made.root);
  } catch (error) {
    const why = element('p', { class: 'trouble', role: 'alert' }, (error as Error).message);
    place?.replaceChildren(element('div', { class: 'fault' }, element('a', { href: '#/', class: 'button quiet' }, '‹ Gallery'), why));
  }
}

window.addEventListener('beforeunload', (event) => {
  if (page?.isAtRisk?.()) event.preventDefault();
});
startTheme();
window.addEventListener('hashchange', () => void route());
history.replaceState(null, '', location.pathname + location.hash); // without the token
void route();
