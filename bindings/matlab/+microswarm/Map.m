classdef Map < microswarm.internal.Handle
% microswarm.Map  Walls of a workspace, with exact distances to them.
%
%   map = microswarm.Map('vessels.geojson');
%   map = microswarm.Map(picture > 128, 9);     % a pixel has a side of 9 um
%   map = microswarm.Map('chip.png', 9, 'free', 'dark', 'threshold', 90);
%
% Lengths are in um; y points up, and the origin of a matrix is its lower left corner.
%
% Methods: bounds, clearance, close. A map that is cleared is closed.
% Errors: microswarm:bad_input for a file, matrix or position; microswarm:bad_call after close.

% SPDX-License-Identifier: Apache-2.0
  methods
    function self = Map(source, um_per_px, varargin)
    % Map(source, um_per_px, name, value, ...)
    %
    % source      a picture, ROS .yaml, MovingAI .map, GeoJSON, SVG, CSV of rectangles or matrix of 0 and 1; or a
    %             matrix, the upper row first: of class logical free where it is true, of only 0 and 1 of any
    %             class where it is 1; others of uint8 are grey pictures, free where they are at least 128, as in a file
    % um_per_px   side of a pixel or cell [um]; needed if the file does not contain it
    % threshold   a pixel is free if it is at least this; other matrices than those need it
    % free        'bright', or 'dark': a pixel is free if it is below the threshold
    % others      of a file, keys of `map` in a scenario: 'um_per_unit', 'wall', 'simplify_um', ...
    %
    % What was assumed in reading a file is a warning, microswarm:note.
      microswarm.internal.need(nargin, 1, 'a map needs a file or a matrix');
      if nargin < 2, um_per_px = 0; end
      if isa(source, 'string') && isscalar(source), source = char(source); end
      settings = {};
      if ischar(source)
        settings = microswarm.internal.settings_of(varargin, 'map.');
      elseif isequal(um_per_px, 0)
        error('microswarm:bad_input', 'a map of a matrix needs um_per_px');
      else
        source = microswarm.internal.free_pixels(source, varargin);
      end
      opened = microswarm_mex('map_open', source, um_per_px, settings);
      self.id = opened.id;
      if ~isempty(opened.notes), warning('microswarm:note', '%s', opened.notes); end
    end

    function box = bounds(self)
    % box = map.bounds()   [x_lo y_lo x_hi y_hi] in um.
      box = microswarm_mex('map_bounds', self.id);
    end

    function distances = clearance(self, places_um)
    % distances = map.clearance(places_um)   Distance of each row x, y from walls and border [um]; 0 in a wall.
      microswarm.internal.need(nargin, 2, 'clearance needs places_um');
      distances = microswarm_mex('map_clearance', self.id, places_um);
    end
  end
end
