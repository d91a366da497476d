// SPDX-License-Identifier: Apache-2.0
// What a person does around the scene: time, parameters, plots, record.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { openPage, startBrowser, startLab } from './lab.mjs';

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser.close());

/** Opens a scenario in a lab of its own, calls `act` with its page and ends both. */
async function inLab(file, act) {
  const lab = await startLab(file);
  const lookedAt = await openPage(browser, lab.url);
  await lookedAt.page.waitForSelector('.form .field', { state: 'attached' });
  await act(lookedAt.page, lookedAt);
  await lookedAt.close();
  assert.equal(await lab.stop(), 0);
}

const clock = async (page) => Number.parseFloat(await page.locator('.clock').innerText());
const until = (page, does, wanted) => page.waitForFunction(does, wanted, { timeout: 60_000 });

test('keys play, tick, seek, change the speed and show themselves', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    await page.keyboard.press('.');
    await page.keyboard.press('.');
    await until(page, () => document.querySelector('.scrub').max >= 1);
    await page.keyboard.press('+');
    await until(page, () => document.querySelector('.speed').value === '2');
    await page.keyboard.press('Space');
    await until(page, () => Number.parseFloat(document.querySelector('.clock').value) > 2);
    await page.keyboard.press('Space');
    await until(page, () => document.querySelector('.play').textContent.includes('Play'));
    const there = await clock(page);
    await page.keyboard.press('Home');
    await until(page, () => Number.parseFloat(document.querySelector('.clock').value) < 0.3);
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('End');
    await until(page, (t) => Number.parseFloat(document.querySelector('.clock').value) >= t, there);
    await page.keyboard.press('?');
    await page.waitForSelector('dialog[open]');
    await picture('keys');
    await page.keyboard.press('Escape');
    await page.keyboard.press('m');
    await page.waitForSelector('[data-mode="manual"]');
    await page.keyboard.press('m');
    await page.waitForSelector('[data-mode="autonomous"]');
  }));

test('one scrubs over what was recorded, and a click in a plot seeks', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    await page.selectOption('.speed', '0');
    await page.click('.play');
    await page.waitForSelector('[data-status="solved"]', { timeout: 120_000 });
    const end = await clock(page);
    await page.locator('.scrub').evaluate((slider) => {
      slider.value = String(Math.round(slider.max / 2));
      slider.dispatchEvent(new Event('input'));
    });
    await until(page, (t) => Math.abs(Number.parseFloat(document.querySelector('.clock').value) - t / 2) < 0.3, end);
    await page.getByRole('tab', { name: 'Plots' }).click();
    const plot = page.locator('.plots .u-over').first();
    const box = await plot.boundingBox();
    await page.mouse.move(box.x + box.width * 0.25, box.y + box.height / 2);
    await page.mouse.click(box.x + box.width * 0.25, box.y + box.height / 2);
    await until(page, (t) => Number.parseFloat(document.querySelector('.clock').value) < 0.45 * t, end);
    await page.mouse.move(box.x + box.width * 0.6, box.y + box.height / 2);
    await page.waitForSelector('.tip:not([hidden])');
    await picture('scrub');
    await page.click('.live');
    await until(page, (t) => Number.parseFloat(document.querySelector('.clock').value) >= t, end);
  }));

test('a slider changes the parameter, and the change is listed and in the command', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    const key = 'navigator.speed_um_per_s';
    const row = page.locator(`.field[data-key="${key}"]`);
    await page.fill('.parameters .search', 'commanded speed');
    const before = await row.locator('.number').inputValue();
    await row.locator('.slider').focus();
    for (let i = 0; i < 5; ++i) await page.keyboard.press('ArrowLeft');
    await until(page, (was) => document.getElementById('field-navigator.speed_um_per_s').value !== was, before);
    const after = await row.locator('.number').inputValue();
    await page.getByRole('tab', { name: 'Record' }).click();
    await page.locator('.changes', { hasText: `${key}=${after}` }).waitFor();
    assert.match(await page.locator('.command').innerText(), new RegExp(`microswarm run .*--set ${key}=${after}`));
    await picture('record');
  }));

test('a bad value is named at its field; what needs a restart waits for one', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    await page.fill('.parameters .search', 'goal_tolerance_um');
    await page.fill('[id="field-goal_tolerance_um"]', '-5');
    await page.keyboard.press('Enter');
    await page.locator('.field[data-key="goal_tolerance_um"] .issue:not([hidden])').waitFor();
    await page.fill('.parameters .search', '');
    await page.fill('[id="field-seed"]', '7');
    await page.keyboard.press('Enter');
    await page.locator('.waiting', { hasText: 'One change' }).waitFor();
    await picture('parameters');
    await page.click('.restart');
    await page.locator('.waiting').waitFor({ state: 'hidden' });
    assert.equal(await page.locator('[id="field-seed"]').inputValue(), '7');
    await page.getByRole('tab', { name: 'Record' }).click();
    await page.locator('.command', { hasText: '--set seed=7' }).waitFor();
  }));

test('two runs stand side by side with their difference', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    await page.getByRole('tab', { name: 'Record' }).click();
    await page.click('.record .compare');
    await page.waitForSelector('.side[data-side="B"] .scene');
    await page.getByRole('tab', { name: 'Parameters B' }).click();
    const row = page.locator('[role=tabpanel]:not([hidden]) .field[data-key="navigator.speed_um_per_s"]');
    await row.locator('.number').fill('40');
    await page.keyboard.press('Enter');
    await page.locator('.side[data-side="B"] .own', { hasText: '40' }).waitFor();
    await page.getByRole('tab', { name: 'Metrics' }).click();
    await page.selectOption('.speed', '0');
    await page.click('.play');
    for (const side of ['A', 'B'])
      await page.waitForSelector(`.side[data-side="${side}"][data-status="solved"]`, { timeout: 120_000 });
    const cells = await page.locator('tr[data-metric="time_s"] td').allInnerTexts();
    assert.ok(Number(cells[1]) > Number(cells[0]), cells.join());
    assert.ok(Math.abs(Number(cells[2]) - (Number(cells[1]) - Number(cells[0]))) < 0.1, cells.join());
    await picture('compare');
  }));
