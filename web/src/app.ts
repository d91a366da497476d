// SPDX-License-Identifier: Apache-2.0
import './app.css';
import { galleryPage } from './gallery';
import { sessionPage } from './session_page';

/** A page in the window, and how it is left. */
export interface Page {
  root: HTMLElement;
  leave(): void;
}

let page: Page | undefined;

/** Shows the page that the address names: #/session/7, else the gallery. */
async function route(): Promise<void> {
  page?.leave();
  const session = /^#\/session\/(\d+)$/.exec(location.hash);
  page = session ? await sessionPage(Number(session[1])) : await galleryPage();
  document.getElementById('page')?.replaceChildren(page.root);
}

window.addEventListener('hashchange', () => void route());
history.replaceState(null, '', location.pathname + location.hash); // without the token
void route();
