// SPDX-License-Identifier: Apache-2.0
// From a photograph to a swarm that goes through its vessels, and to robots that gather in them.
import assert from 'node:assert/strict';
import { existsSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { openPage, root, startBrowser, startLab } from './lab.mjs';

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser.close());

const sample = join(root, 'tests/samples/vessels/retina.png');
const data = process.env.MICROSWARM_DATA && join(process.env.MICROSWARM_DATA, 'vessels');
const real = data && existsSync(data) ? readdirSync(data).find((one) => /^CHASE_\w+\.jpg$/.test(one)) : undefined;

async function withPhoto(file, act) {
  const lab = await startLab();
  const lookedAt = await openPage(browser, lab.url);
  const { page } = lookedAt;
  await page.waitForSelector('.card');
  await page.setInputFiles('input[type=file]', file);
  await page.waitForSelector('.photo-page');
  await act(page, lookedAt);
  await lookedAt.close();
  assert.equal(await lab.stop(), 0);
}

/** Clicks shares of the photograph's width and height. */
async function clickAt(page, x, y) {
  const box = await page.locator('.photo-frame').boundingBox();
  await page.mouse.click(box.x + x * box.width, box.y + y * box.height);
}
const found = (page) => page.locator('output', { hasText: 'Vessels cover' }).waitFor({ timeout: 60_000 });

test('a photograph becomes a map in which robots gather', () =>
  withPhoto(sample, async (page, { picture }) => {
    await clickAt(page, 0.1, 0.5);
    await page.locator('.photo-frame').focus();
    for (let i = 0; i < 8; ++i) await page.keyboard.press('Shift+ArrowRight');
    await page.keyboard.press('Enter');
    await page.fill('#photo-distance', '800');
    await page.keyboard.press('Tab');
    assert.ok(Number(await page.inputValue('#photo-um-per-px')) > 0);
    await picture('photo-scale');
    await page.getByRole('button', { name: 'Next' }).click();
    await found(page);
    await picture('photo-vessels');
    await page.getByRole('button', { name: 'Next' }).click();
    await page.locator('.photo-side .switch').check();
    await page.fill('#photo-robots', '32');
    await clickAt(page, 0.5, 0.5);
    await picture('photo-places');
    await page.getByRole('button', { name: 'Make the experiment' }).click();
    await page.waitForSelector('.session', { timeout: 60_000 });
    await page.selectOption('.timebar .speed', '0');
    await page.click('.play');
    await page.waitForSelector('[data-status="solved"]', { timeout: 120_000 });
    assert.ok(
      await page.evaluate(() => window.microswarm.scene.stack.background.isThere),
      'the photograph lies beneath',
    );
    await picture('photo-gathered');
    await page.goBack();
    await page.waitForSelector('.photo-page');
    assert.notEqual(await page.inputValue('#photo-um-per-px'), '1', 'the photograph is as it was left');
    assert.ok(await page.getByRole('button', { name: 'Make the experiment' }).isEnabled());
  }));

test('the vessels of a real photograph are found', { skip: !real && 'no data' }, () =>
  withPhoto(join(data ?? '', real ?? ''), async (page, { picture }) => {
    await page.fill('#photo-um-per-px', '10');
    await page.keyboard.press('Tab');
    await page.getByRole('button', { name: 'Next' }).click();
    await found(page);
    await picture('photo-real');
  }),
);

test('a wrong file is refused in one line, and a scenario is opened', async () => {
  const lab = await startLab();
  const { page, complaints } = await openPage(browser, lab.url);
  await page.waitForSelector('.card');
  await page.setInputFiles('input[type=file]', {
    name: 'notes.txt',
    mimeType: 'text/plain',
    buffer: Buffer.from('hello'),
  });
  await page.locator('.trouble', { hasText: 'notes.txt: neither a photograph' }).waitFor();
  await page.setInputFiles('input[type=file]', { name: 'a.png', mimeType: 'image/png', buffer: Buffer.from('hello') });
  await page.locator('.trouble', { hasText: 'a.png' }).waitFor();
  await page.setInputFiles('input[type=file]', join(root, 'scenarios/first_flight.yaml'));
  await page.waitForSelector('.session');
  // The refusals themselves.
  assert.ok(
    complaints.every((one) => one.includes('status of 400')),
    complaints.join(),
  );
  assert.equal(await lab.stop(), 0);
});
