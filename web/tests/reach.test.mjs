// SPDX-License-Identifier: Apache-2.0
// The page without a mouse: by keys alone, by touch, at the width of a phone, in forced colours and on paper.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { inLab as inLabOf, startBrowser, until } from './lab.mjs';

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser.close());
const inLab = (...rest) => inLabOf(browser, ...rest);

test('an obstacle is added, moved and removed by keys alone, and the steps are said', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    const obstacles = () => page.evaluate(() => window.microswarm.connection.hello.scenario.obstacles);
    const press = async (keys) => {
      for (const key of keys) await page.keyboard.press(key);
    };
    const reach = async (name, limit = 60) => {
      const names = [];
      for (let i = 0; i < limit; ++i) {
        await page.keyboard.press('Tab');
        const at = await page.evaluate(() => {
          const { activeElement: at } = document;
          return at?.matches('summary, button') ? at.innerText : '';
        });
        names.push(at);
        if (at.startsWith(name)) return;
      }
      assert.fail(`${name} is not among ${names.join(' | ')}`);
    };
    await reach('obstacles');
    await press(['Enter']);
    await reach('Add a disc');
    await press(['Enter']);
    await until(page, () => window.microswarm.connection.hello.scenario.obstacles.length === 3);
    assert.match(await page.locator('.moved').innerText(), /radius 50 µm at 1000, 500 µm/);
    await page.locator('.group[data-key="obstacles.2"] > summary').focus(); // the last of the list
    await press(['Enter']);
    await page.locator('[id="field-move-2"]').focus();
    await press(['Enter', 'ArrowRight', 'ArrowRight', 'Shift+ArrowDown']);
    await page.locator('.moved', { hasText: 'Obstacle 2 at 1040, 300 µm' }).waitFor();
    assert.deepEqual((await obstacles())[2].motion.position_um, [1040, 300]);
    assert.ok(await page.evaluate(() => document.activeElement.matches('.move[aria-pressed=true]')));
    await picture('move-by-keys');
    await press(['Escape', 'ArrowRight']);
    assert.equal(await page.locator('[id="field-move-2"]').innerText(), 'Move');
    await page.waitForTimeout(300);
    assert.deepEqual((await obstacles())[2].motion.position_um, [1040, 300]);
    await press(['Tab', 'Enter']); // Remove
    await until(page, () => window.microswarm.connection.hello.scenario.obstacles.length === 2);
  }));

test('a stick on the screen steers, and lets go', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    await page.setViewportSize({ width: 390, height: 800 });
    assert.equal(await page.locator('.stick').isVisible(), false);
    await page.getByRole('button', { name: 'Steer' }).click();
    await page.waitForSelector('[data-mode="manual"]');
    await page.click('.play');
    const box = await page.locator('.stick').boundingBox();
    const middle = [box.x + box.width / 2, box.y + box.height / 2];
    const y = () => window.microswarm.connection.history.column('y_um').at(-1) ?? 0;
    const session = await page.context().newCDPSession(page);
    const touch = (type, points) =>
      session.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y]) => ({ x, y })) });
    await touch('touchStart', [middle]);
    await touch('touchMove', [[middle[0], middle[1] - 40]]);
    await until(page, () => (window.microswarm.connection.history.column('y_um').at(-1) ?? 0) > 510);
    await picture('stick');
    await touch('touchEnd', []);
    await page.waitForTimeout(1000); // a command lasts half a second
    const there = await page.evaluate(y);
    await page.waitForTimeout(1000);
    assert.ok(Math.abs((await page.evaluate(y)) - there) < 1, 'it stands');
    assert.match(await page.locator('.stick .knob').getAttribute('style'), /translate: 0px/);
    await page.getByRole('button', { name: 'Steer' }).click();
    await page.waitForSelector('.stick', { state: 'hidden' });
  }));

test('everything is in reach at the width of a phone and of half a screen', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    for (const width of [390, 640]) {
      await page.setViewportSize({ width, height: 800 });
      await page.waitForTimeout(300);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      assert.ok(wide <= width, `${wide} px in ${width}`);
      assert.ok(await page.locator('.timeline').evaluate((one) => one.clientWidth > 150));
      // The tools lie above the map, not on it.
      const gap = await page.evaluate(() => {
        const { view } = window.microswarm.scene;
        const canvas = document.querySelector('.scene canvas').getBoundingClientRect();
        const tools = Math.max(
          ...[...document.querySelectorAll('.over .tools')].map((one) => one.getBoundingClientRect().bottom),
        );
        return canvas.top + view.y - view.scale * view.hi[1] - tools;
      });
      assert.ok(gap >= 0, `${gap} px at ${width}`);
      await picture(`width-${width}`);
    }
  }));

test('forced colours and paper show what is there', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    await page.keyboard.press('.');
    await page.emulateMedia({ forcedColors: 'active' });
    await picture('forced-colours');
    const thumb = await page.locator('.scrub').evaluate((one) => getComputedStyle(one).appearance);
    assert.equal(thumb, 'auto'); // drawn by the system
    await page.getByRole('button', { name: 'Light or dark' }).click(); // to dark
    await page.emulateMedia({ forcedColors: 'none', media: 'print' });
    await picture('print');
    const [back, ink] = await page.evaluate(() => {
      const [tabs, panel] = ['.tabs', '.panel:not([hidden])'].map((one) =>
        getComputedStyle(document.querySelector(one)),
      );
      return [tabs.backgroundColor, panel.color];
    });
    assert.equal(back, 'rgb(255, 255, 255)'); // also in the dark theme
    assert.equal(ink, 'rgb(27, 31, 36)');
    const pixel = await page
      .locator('.scene canvas.paper')
      .evaluate((canvas) => [...canvas.getContext('2d').getImageData(canvas.width / 2, canvas.height / 4, 1, 1).data]);
    assert.ok(
      pixel.every((one) => one > 200),
      pixel.join(),
    );
    assert.equal(await page.locator('.timebar').isVisible(), false);
    await page.emulateMedia({ media: 'screen' });
    await page.waitForSelector('.scene canvas.paper', { state: 'detached' });
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark');
  }));
