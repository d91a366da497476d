function text = value_text(value, name)
% microswarm.internal.value_text  A value as in a scenario file: 60, true, [1500, 300], [[0, 0], [1, 2]].
%
% A row or column is a list; a matrix with more of both is a list of its rows; a cell array is a list.

  % SPDX-License-Identifier: Apache-2.0
  if isa(value, 'string') && isscalar(value), value = char(value); end
  if ischar(value) && isrow(value)
    text = value;
  elseif iscell(value)
    parts = cellfun(@(one) microswarm.internal.value_text(one, name), value(:)', 'UniformOutput', false);
    text = ['[' strjoin(parts, ', ') ']'];
  elseif ~(isnumeric(value) || islogical(value)) || ~isreal(value) || ndims(value) > 2
    error('microswarm:bad_input', '%s: a value must be a text, real numbers, true or false, not of class %s', ...
          name, class(value));
  elseif ~all(isfinite(value(:)))
    error('microswarm:bad_input', '%s: a value must be finite', name);
  elseif isscalar(value)
    text = scalar_text(value);
  elseif isempty(value) || isvector(value)
    parts = arrayfun(@scalar_text, full(value(:)'), 'UniformOutput', false);
    text = ['[' strjoin(parts, ', ') ']'];
  else
    text = microswarm.internal.value_text(num2cell(value, 2), name);
  end
end

function text = scalar_text(value)
  if islogical(value)
    words = {'false', 'true'};
    text = words{value + 1};
  elseif isinteger(value)
    text = sprintf('%d', value);
  else
    text = sprintf('%.17g', value);
  end
end
