function free = free_pixels(picture, values)
% microswarm.internal.free_pixels  Which pixels of a matrix are free, by its values 'threshold' and 'free'.
%
% Of a mask, of class logical or of 0 and 1 of any class, 1 is bright; a grey picture of uint8 is bright from 128
% on. Other matrices need a threshold: without, they are left as they are.

  % SPDX-License-Identifier: Apache-2.0
  threshold = [];
  bright = true;
  for k = 1:2:numel(values)
    name = microswarm.internal.plain_text(values{k}, 'the name of a value');
    if k == numel(values), error('microswarm:bad_input', 'the value of %s is missing', name); end
    value = values{k + 1};
    switch name
      case 'threshold'
        if ~isnumeric(value) || ~isreal(value) || ~isscalar(value) || ~isfinite(value)
          error('microswarm:bad_input', 'threshold must be a number');
        end
        threshold = double(value);
      case 'free'
        word = microswarm.internal.plain_text(value, 'free');
        if ~any(strcmp(word, {'bright', 'dark'}))
          error('microswarm:bad_input', 'free must be bright or dark, not %s', word);
        end
        bright = strcmp(word, 'bright');
      otherwise
        error('microswarm:bad_input', '%s is no value of a matrix, which takes threshold and free', name);
    end
  end
  free = picture;
  if islogical(picture)
    threshold = 1;
  elseif isempty(threshold)
    is_numbers = isnumeric(picture) && isreal(picture) && ~issparse(picture);
    if is_numbers && all(picture(:) == 0 | picture(:) == 1)
      threshold = 1;
    elseif isa(picture, 'uint8')
      threshold = 128;
    else
      return;
    end
  elseif ~isnumeric(picture) || ~isreal(picture) || issparse(picture)
    return;
  elseif ~all(isfinite(picture(:)))
    error('microswarm:bad_input', 'a map of a matrix must be finite');
  end
  free = (picture >= threshold) == bright;
  if ~isempty(free) && ~any(free(:)) && any(picture(:) ~= 0)
    sides = {'largest', max(double(picture(:))), 'from'};
    if ~bright, sides = {'smallest', min(double(picture(:))), 'below'}; end
    error('microswarm:bad_input', 'all of the image is wall: its %s value is %g, free pixels are those %s %g', sides{:}, threshold);
  end
end
