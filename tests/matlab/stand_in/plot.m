% SPDX-License-Identifier: Apache-2.0
function plot(x, y)
% plot  Draws nothing; there is something to draw.
  assert(isreal(x) && numel(x) > 10 && isequal(size(x), size(y)));
end
