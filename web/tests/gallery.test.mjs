// SPDX-License-Identifier: Apache-2.0
// The gallery: what it lists, what it says of it, and files that are dropped.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFileSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { openPage, program, root, startBrowser, startLab, until } from './lab.mjs';

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser.close());

test('scenarios with mistakes say which, records say what they are, and files are dropped anywhere', async () => {
  const folder = mkdtempSync(join(tmpdir(), 'lab-gallery-'));
  const flight = readFileSync(join(root, 'scenarios/first_flight.yaml'), 'utf8');
  mkdirSync(join(folder, 'day_1'));
  copyFileSync(join(root, 'scenarios/first_flight.yaml'), join(folder, 'good.yaml'));
  writeFileSync(join(folder, 'broken.yaml'), `${flight}\n  odd: [1, 2\n`);
  writeFileSync(join(folder, 'wrong.yaml'), `${flight}\nno_such_key: 1\n`);
  execFileSync(program, ['run', join(folder, 'good.yaml'), '--out', join(folder, 'day_1')], { stdio: 'ignore' });
  const lab = await startLab('--folder', folder);
  const { page, picture, close } = await openPage(browser, lab.url, { width: 1920, height: 900 });
  const card = (name) => page.locator(`.card[data-file$="${name}"]`);
  await card('broken.yaml').locator('.issue', { hasText: 'YAML' }).waitFor();
  await card('wrong.yaml').locator('.issue', { hasText: 'no_such_key' }).waitFor();
  await card('run.h5').scrollIntoViewIfNeeded();
  assert.match(await card('run.h5').innerText(), /day_1 \/ run[\s\S]*solved/i);
  await card('run.h5').locator('img:not(.none)').waitFor();
  await page.waitForTimeout(1500);
  assert.ok(
    await card('run.h5')
      .locator('img')
      .evaluate((one) => one.naturalWidth > 100),
  );
  const headings = await page.locator('.gallery h2').allInnerTexts();
  assert.ok(
    headings.some((one) => /first steps/i.test(one)),
    headings.join(),
  );
  assert.ok(
    headings.every((one) => !one.includes('usr')),
    headings.join(),
  );
  await picture('gallery-own');
  await page.getByRole('button', { name: 'Light or dark' }).click();
  await picture('gallery-own-dark');
  // Beside the column of cards too.
  const taken = await page.evaluate((text) => {
    const data = new DataTransfer();
    data.items.add(new File([text], 'dropped.yaml'));
    const event = (type) =>
      new DragEvent(type, { dataTransfer: data, bubbles: true, cancelable: true, clientX: 5, clientY: 600 });
    const at = document.elementFromPoint(5, 600);
    at.dispatchEvent(event('dragover'));
    const shown = !document.querySelector('.drop-here').hidden;
    const drop = event('drop');
    at.dispatchEvent(drop);
    return shown && drop.defaultPrevented;
  }, flight);
  assert.ok(taken);
  await page.waitForSelector('.session .play');
  await close();
  assert.equal(await lab.stop(), 0);
  rmSync(folder, { recursive: true });
});

test('a card opens once however often it is clicked, and an open run can be closed', async () => {
  const lab = await startLab();
  const { page, close } = await openPage(browser, lab.url);
  await page.waitForSelector('.card');
  const runs = () => page.evaluate(async () => (await (await fetch('/api/sessions')).json()).sessions);
  for (const changed of [false, true]) {
    await page.locator('.card[data-file$="first_flight.yaml"]').evaluate((card) => {
      card.click();
      card.click();
    });
    await page.waitForSelector('.session .form .field', { state: 'attached' });
    assert.equal((await runs()).length, 1 + Number(changed));
    if (changed) {
      await page.click('.step');
      await page.fill('[id="field-goal_tolerance_um"]', '33');
      await page.keyboard.press('Enter');
      await until(page, () => window.microswarm.connection.standing.changes.length === 1);
    }
    await page.getByRole('link', { name: '‹ Gallery' }).click();
    if (changed) await page.click('.loss .anew');
    await page.waitForSelector('.open-runs');
  }
  const close1 = page.getByRole('button', { name: /^Close first_flight.yaml · 0.0 s$/ });
  await close1.click();
  await until(page, () => document.querySelectorAll('.open-runs li').length === 1);
  assert.equal((await runs()).length, 1);
  const changed = page.getByRole('button', { name: /^Close first_flight.yaml .* changed$/ });
  await changed.click();
  await page.click('.loss .keep');
  assert.equal((await runs()).length, 1);
  await changed.click();
  await page.click('.loss .anew');
  await page.waitForSelector('.open-runs', { state: 'hidden' });
  assert.deepEqual(await runs(), []);
  await close();
  assert.equal(await lab.stop(), 0);
});
