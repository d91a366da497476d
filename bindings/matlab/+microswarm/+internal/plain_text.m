function text = plain_text(value, name)
% microswarm.internal.plain_text  A text of one row from '...' or "..."; an error names what is none.

  % SPDX-License-Identifier: Apache-2.0
  if isa(value, 'string') && isscalar(value), value = char(value); end
  if ~ischar(value) || ~isrow(value)
    error('microswarm:bad_input', '%s must be a text, not of class %s', name, class(value));
  end
  text = value;
end
