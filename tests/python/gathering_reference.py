# SPDX-License-Identifier: Apache-2.0
"""The rules of gym-gathering said again with NumPy, whole arrays at a time as that package works: the
oracle of the tests, and the peer of the bench. It takes its particles and their weights from outside.
"""

from collections import deque

import numpy as np

MOVES = np.array([(0, 1), (1, 1), (1, 0), (1, -1), (0, -1), (-1, -1), (-1, 0), (-1, 1)])


def costs_to(free, place):
    """Steps from every cell to a place (row, column); 0 where it cannot be reached."""
    costs = np.zeros(free.shape, dtype=int)
    seen = ~free
    seen[place] = True
    queue = deque([place])
    while queue:
        y, x = queue.popleft()
        for dy, dx in MOVES:
            at = y + dy, x + dx
            if 0 <= at[0] < free.shape[0] and 0 <= at[1] < free.shape[1] and not seen[at]:
                seen[at] = True
                costs[at] = costs[y, x] + 1
                queue.append(at)
    return costs


def length_estimate(free, mean_cost):
    """Steps of an episode, estimated from the farthest cell and the rarest kind of corner."""
    wall = ~np.pad(free, 1)
    inner = ~wall[1:-1, 1:-1]
    above, below, left, right = wall[:-2, 1:-1], wall[2:, 1:-1], wall[1:-1, :-2], wall[1:-1, 2:]
    left_to_count = inner.copy()
    corners = []
    for one in (below & right, below & left, above & right, above & left):
        kind = left_to_count & one
        corners.append(kind.sum())
        left_to_count &= ~kind
    cells = np.argwhere(free)
    lowest, rightmost = cells[cells[:, 0].argmax()], cells[cells[:, 1].argmax()]
    extreme = lowest if lowest.sum() > rightmost.sum() else rightmost
    return int(0.75 * costs_to(free, tuple(extreme)).max() * np.log(mean_cost * min(corners)))


class Reference:
    """One episode with a fixed goal and one channel."""

    def __init__(self, free, goal, physics="algorithmic", goal_range=10, seed=None):
        self.free, self.physics, self.goal_range = np.asarray(free, bool), physics, goal_range
        self.costs = costs_to(self.free, (goal[1], goal[0]))
        self.mean_cost = self.costs[self.costs > 0].mean()
        self.estimate = length_estimate(self.free, self.mean_cost)
        self.random = np.random.RandomState(seed)

    def begin(self, particles, weights=None):
        """`particles` are rows and columns."""
        self.particles = np.array(particles)
        self.exact, self.speed = self.particles.astype(float), np.zeros(self.particles.shape)
        self.weights = np.ones(len(particles)) if weights is None else weights
        self.scale = self.last_total = self.mean_cost * len(self.particles)
        self.last_max = self.costs.max()

    def step(self, action):
        if self.physics == "physical":
            self._physical(MOVES[action])
        else:
            update = np.tile(MOVES[action], (len(self.particles), 1))
            if self.physics == "fuzzy":
                update = self._fuzzy(update)
            aims = self.particles + update
            valid = self.free.ravel()[aims[:, 0] * self.free.shape[1] + aims[:, 1]]
            self.particles = np.where(valid[:, None], aims, self.particles)
        now = self.costs.ravel()[self.particles[:, 0] * self.costs.shape[1] + self.particles[:, 1]]
        total, farthest = now.sum(), now.max()
        reward = (self.last_total - total) / self.scale + (self.last_max - farthest) / self.costs.max() - 1 / self.estimate
        self.last_total, self.last_max = total, farthest
        return self.picture(), reward, bool(farthest <= self.goal_range)

    def picture(self):
        image = np.zeros(self.free.shape)
        image[self.particles[:, 0], self.particles[:, 1]] = 255
        return image[:, :, np.newaxis]

    def _fuzzy(self, update):
        shape = self.free.shape
        moves = self.random.randint(-1, 2, shape + (2,)) * self.random.choice([0, 1], shape + (1,), p=[0.75, 0.25])
        stays = self.random.choice([0, 1], shape + (1,), p=[0.25, 0.75])
        y, x = self.particles.T
        return np.where(stays[y, x], update + moves[y, x], 0)

    def _physical(self, move, force=0.05, drag=1.025, most=3):
        self.speed = self.speed + np.outer(force / self.weights, move)
        aims = np.clip(np.rint(self.exact + self.speed).astype(int), 0, np.array(self.free.shape) - 1)
        moves = self.free[aims[:, 0], aims[:, 1]]
        stopped = -1
        while (~moves).sum() > stopped:
            stopped = (~moves).sum()
            present = np.where(moves[:, None], aims, self.particles)
            cells, counts = np.unique(present, axis=0, return_counts=True)
            held = np.zeros(self.free.shape, dtype=int)
            held[cells[:, 0], cells[:, 1]] = counts
            moves = moves & (held[present[:, 0], present[:, 1]] <= most)
        moves = moves | (aims == self.particles).all(axis=1)
        self.particles = np.where(moves[:, None], aims, self.particles)
        self.exact = np.where(moves[:, None], self.exact + self.speed, self.exact)
        self.speed = self.speed / drag
        self.speed = np.where(moves[:, None], self.speed, self.speed / 4)
        fast = np.abs(self.speed) > 0.01
        self.speed = np.where(fast, self.speed, 0)
        self.exact = np.where(fast, self.exact, np.rint(self.exact))
