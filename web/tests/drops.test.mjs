// SPDX-License-Identifier: Apache-2.0
// Files that are dropped on any page: the browser must not leave it for them.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { inLab as inLabOf, root, startBrowser, until } from './lab.mjs';

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser.close());
const inLab = (...rest) => inLabOf(browser, ...rest);
const flight = readFileSync(join(root, 'scenarios/first_flight.yaml'), 'utf8');

/** Drops a scenario in the middle of the window; whether the page took it. */
function drop(page, text) {
  return page.evaluate((text) => {
    const data = new DataTransfer();
    data.items.add(new File([text], 'dropped.yaml'));
    const at = document.elementFromPoint(innerWidth / 2, innerHeight / 2);
    const event = (type) => new DragEvent(type, { dataTransfer: data, bubbles: true, cancelable: true });
    const over = event('dragover');
    at.dispatchEvent(over);
    const drop = event('drop');
    at.dispatchEvent(drop);
    return over.defaultPrevented && drop.defaultPrevented;
  }, text);
}

test('a scenario that is dropped on a session opens, and a wrong one says why', () =>
  inLab('scenarios/first_flight.yaml', async (page, { complaints }) => {
    const first = page.url();
    assert.ok(await drop(page, 'no_such_key: 1'));
    await page.locator('.top .trouble', { hasText: 'no_such_key' }).waitFor();
    assert.equal(page.url(), first);
    assert.ok(await drop(page, flight));
    await until(page, (first) => location.href !== first, { wanted: first });
    await page.waitForSelector('.form .field', { state: 'attached' });
    await page.getByRole('tab', { name: 'Record' }).click();
    await page.click('.record .compare');
    await page.waitForSelector('.side[data-side="B"] .scene');
    assert.ok(await drop(page, 'no_such_key: 1'));
    await page.locator('.top .trouble', { hasText: 'no_such_key' }).waitFor();
    for (const one of complaints.splice(0)) assert.match(one, /400/); // it was refused
  }));

test('a file that is dropped on an armed rig does not stop it', () =>
  inLab(
    'scenarios/first_rig.yaml',
    async (page) => {
      await page.getByRole('button', { name: 'Arm …' }).click();
      await page.getByRole('button', { name: 'Arm: drive the coils' }).click();
      await page.waitForSelector('.rigbar[data-state="armed"]');
      const there = page.url();
      assert.ok(await drop(page, flight));
      await page.locator('.top .trouble', { hasText: 'stop the rig before' }).waitFor();
      assert.equal(page.url(), there);
      await page.keyboard.press('Space');
      await page.waitForSelector('.rigbar[data-state="ended"]');
    },
    '--rig',
    'scenarios/rigs/vortex.yaml',
  ));
