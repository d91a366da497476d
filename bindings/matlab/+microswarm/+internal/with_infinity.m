function value = with_infinity(value)
% microswarm.internal.with_infinity  Metrics with Inf for a distance that never came about, null in JSON.

  % SPDX-License-Identifier: Apache-2.0
  if isstruct(value)
    names = fieldnames(value);
    for k = 1:numel(names)
      value.(names{k}) = microswarm.internal.with_infinity(value.(names{k}));
    end
  elseif isnumeric(value) && isempty(value)
    value = Inf;
  end
end
