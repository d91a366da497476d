// SPDX-License-Identifier: Apache-2.0
// The form of the parameters: what is typed, what is refused, what waits.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { inLab as inLabOf, startBrowser, until } from './lab.mjs';

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser.close());

const inLab = (...rest) => inLabOf(browser, ...rest);
/** Types a value into the field of a key. */
async function type(page, key, value) {
  await page.locator(`[id="field-${key}"]`).evaluate((entry) => {
    for (let group = entry.closest('details'); group; group = group.parentElement.closest('details')) group.open = true;
  });
  await page.fill(`[id="field-${key}"]`, value);
  await page.keyboard.press('Tab');
}
const issuesAt = (page) =>
  page.evaluate(() =>
    [...document.querySelectorAll('.field .issue:not([hidden])')]
      .map((one) => one.closest('.field').dataset.key)
      .sort(),
  );

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

test('what is no value is told at its field, and the old one stays', () =>
  inLab('scenarios/first_flight.yaml', async (page) => {
    const typed = async (key, value) => {
      const entry = page.locator(`[id="field-${key}"]`);
      const before = await entry.inputValue();
      await entry.fill(value);
      await page.keyboard.press('Enter');
      await page.locator(`.field[data-key="${key}"] .issue:not([hidden])`).waitFor();
      // Some are told by the page, others by the server.
      const isBack = ([id, was]) => document.getElementById(id).value === was;
      await until(page, isBack, { wanted: [`field-${key}`, before] });
    };
    for (const value of ['abc', '1500, 300', '[1e999, 2]', '']) await typed('goal_um', value);
    await page.fill('.parameters .search', 'goal_tolerance_um');
    await typed('goal_tolerance_um', '');
  }));

test('several mistakes of a restart are each at their field, in sight, and Discard clears them', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    await type(page, 'start.x_um', '-99999');
    await type(page, 'seed', '-3');
    await type(page, 'swarm.radius_um', '-1');
    await type(page, 'swarm.max_speed_um_per_s', '-7');
    await page.click('.restart');
    await until(page, () => document.querySelectorAll('.field .issue:not([hidden])').length >= 3);
    const at = await issuesAt(page);
    for (const key of ['seed', 'swarm.max_speed_um_per_s', 'swarm.radius_um']) assert.ok(at.includes(key), `${at}`);
    const texts = await page.locator('.field .issue:not([hidden])').allInnerTexts();
    assert.doesNotMatch(texts.join(), /--set/);
    const isInSight = () => {
      const box = document.querySelector('.issue:not([hidden])').getBoundingClientRect();
      const form = document.querySelector('.form').getBoundingClientRect();
      return box.height > 0 && box.top >= form.top && box.bottom <= form.bottom;
    };
    await until(page, isInSight, { seconds: 5 });
    await picture('parameters-mistakes');
    await page.click('.discard');
    assert.deepEqual(await issuesAt(page), []);
    assert.equal(await page.inputValue('[id="field-seed"]'), '1');
  }));

test('a decimal comma is understood, and never dropped', () =>
  inLab('scenarios/first_flight.yaml', async (page) => {
    const speed = () => page.evaluate(() => window.microswarm.connection.hello.scenario.navigator.speed_um_per_s);
    await page.fill('[id="field-navigator.speed_um_per_s"]', '');
    await page.locator('[id="field-navigator.speed_um_per_s"]').pressSequentially('50,5');
    await page.keyboard.press('Enter');
    await until(page, () => window.microswarm.connection.hello.scenario.navigator.speed_um_per_s === 50.5);
    await type(page, 'navigator.speed_um_per_s', '1,000');
    await page.locator('.field[data-key="navigator.speed_um_per_s"] .issue', { hasText: 'decimal point' }).waitFor();
    assert.equal(await speed(), 50.5);
  }));

test('a type of navigator taken again has the values that it had', () =>
  inLab('scenarios/first_flight.yaml', async (page) => {
    const scenario = () => page.evaluate(() => window.microswarm.connection.hello.scenario.navigator);
    const before = await scenario();
    await type(page, 'navigator.speed_um_per_s', '41');
    await until(page, () => window.microswarm.connection.hello.scenario.navigator.speed_um_per_s === 41);
    const menu = '[id="field-navigator.type"]';
    const other = await page
      .locator(`${menu} option`)
      .evaluateAll(
        (all, type) => all.map((one) => one.value).find((one) => one === 'radar' && one !== type),
        before.type,
      );
    for (const type of [other, before.type]) {
      await page.selectOption(menu, type);
      await until(page, (type) => window.microswarm.connection.hello.scenario.navigator.type === type, {
        wanted: type,
      });
    }
    assert.equal((await scenario()).speed_um_per_s, 41);
    for (const type of [other, before.type]) {
      await page.click('.undo');
      await until(page, (type) => window.microswarm.connection.hello.scenario.navigator.type === type, {
        wanted: type,
      });
    }
    await page.click('.undo');
    await until(page, (speed) => window.microswarm.connection.hello.scenario.navigator.speed_um_per_s === speed, {
      wanted: before.speed_um_per_s,
    });
    assert.ok(await page.locator('.undo').isHidden());
  }));

test('a pressed button can be read while the pointer rests on it, light and dark', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    const button = page.getByRole('button', { name: 'Follow' });
    await button.click();
    const contrast = () =>
      button.evaluate((one) => {
        const style = getComputedStyle(one);
        const luminance = (colour) => {
          const [r, g, b] = colour.match(/[\d.]+/g).map((part) => {
            const share = part / 255;
            return share <= 0.03928 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
          });
          return 0.2126 * r + 0.7152 * g + 0.0722 * b;
        };
        const [a, b] = [luminance(style.color), luminance(style.backgroundColor)].sort((x, y) => y - x);
        return (a + 0.05) / (b + 0.05);
      });
    assert.ok((await contrast()) > 4.5, `${await contrast()}`);
    await picture('toggle');
    await page.evaluate(() => (document.documentElement.dataset.theme = 'dark'));
    assert.ok((await contrast()) > 4.5, `dark: ${await contrast()}`);
  }));

test('a click on a label of run B changes run B, and no id is there twice', () =>
  inLab('scenarios/papers/radar/single.yaml', async (page, { picture }) => {
    await page.getByRole('tab', { name: 'Record' }).click();
    await page.click('.record .compare');
    await page.waitForSelector('.side[data-side="B"] .scene');
    await page.getByRole('tab', { name: 'Parameters B' }).click();
    const panel = page.locator('[role=tabpanel]:not([hidden])');
    await panel.locator('.search').fill('adaptive');
    const row = panel.locator('.field[data-key="navigator.safety_radius.adaptive"]');
    const was = await row.locator('input').isChecked();
    await row.locator('label').click();
    await page.locator('.side[data-side="B"] .own', { hasText: `adaptive=${!was}` }).waitFor();
    assert.doesNotMatch(await page.locator('.side[data-side="A"] .own').innerText(), /adaptive/);
    assert.equal(await row.locator('input').isChecked(), !was);
    const twice = await page.evaluate(() => {
      const all = [...document.querySelectorAll('[id]')].map((one) => one.id);
      return all.filter((id, i) => all.indexOf(id) !== i);
    });
    assert.deepEqual(twice, []);
    await picture('compare-label');
  }));
