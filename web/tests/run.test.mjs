// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { openPage, startBrowser, startLab } from './lab.mjs';

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser.close());

test('the gallery lists the shipped scenarios and opens one', async () => {
  const lab = await startLab();
  const lookedAt = await openPage(browser, lab.url);
  const card = lookedAt.page.locator('.card[data-file$="papers/radar/twelve.yaml"]');
  await card.waitFor();
  await lookedAt.picture('gallery');
  await card.click();
  await lookedAt.page.waitForSelector('.play');
  await lookedAt.close();
  await lab.stop();
});

test('a run plays as fast as possible and arrives', async () => {
  const lab = await startLab('scenarios/first_flight.yaml');
  const lookedAt = await openPage(browser, lab.url);
  await lookedAt.page.click('.play');
  await lookedAt.page.waitForSelector('[data-status="solved"]', { timeout: 120_000 });
  await lookedAt.picture('arrived');
  await lookedAt.close();
  assert.equal(await lab.stop(), 0);
});

test('a browser that cannot draw says so', async () => {
  const plain = await startBrowser('--disable-3d-apis');
  const lab = await startLab('scenarios/first_flight.yaml');
  const { page } = await openPage(plain, lab.url);
  await page.locator('.trouble', { hasText: 'WebGL 2' }).waitFor();
  await page.getByRole('link', { name: 'Gallery' }).click();
  await page.waitForSelector('.card');
  await plain.close();
  assert.equal(await lab.stop(), 0);
});
