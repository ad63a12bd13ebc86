function handle = plot(result, quantity, direction)
%PLOT  Draw a result of epicyclic.open in the current axes.
%
%   epicyclic.plot(result)                        the main figure of the kind
%   epicyclic.plot(result, quantity)              a column by its name
%   epicyclic.plot(result, quantity, direction)   'up' or 'down' of a sweep or map; '' for both or the first
%   handle = epicyclic.plot(...)                  handle of the axes
%
%   kind      quantity                                    default
%   sweep     column of points.csv or poincare.csv        delta_sp_1: bifurcation diagram
%   map       column of points.csv with numbers           lyapunov_max
%   basins    column of points.csv with numbers           attractor
%   continue  column of branch.csv or poincare.csv        delta_sp_1: branches
%   run       column of history.csv                       delta_sp_1 over time
%   gear      column of stiffness.csv                     k_sp_N_per_m over the mesh phase
%
%   Read the result as structs: without 'table'.
%
%   See also epicyclic.open.

  if nargin < 2
    quantity = '';
  end
  if nargin < 3
    direction = '';
  end
  handle = gca();
  switch result.kind
    case 'sweep'
      draw_sweep(result, default_to(quantity, 'delta_sp_1'), direction);
    case 'map'
      draw_cells(result, default_to(quantity, 'lyapunov_max'), direction);
    case 'basins'
      draw_cells(result, default_to(quantity, 'attractor'), direction);
    case 'continue'
      draw_branches(result, default_to(quantity, 'delta_sp_1'));
    case 'run'
      draw_lines(result, 'history', 'periods', default_to(quantity, 'delta_sp_1'), 'Time in mesh periods');
    case 'gear'
      quantity = default_to(quantity, 'k_sp_N_per_m');
      draw_lines(result, 'stiffness', 'phase', quantity, 'Mesh phase [mesh periods]');
      ylabel(strrep(quantity, '_N_per_m', '  [N/m]'), 'interpreter', 'none');
    otherwise
      error('epicyclic:figure', 'epicyclic.plot: there is no figure of kind %s', result.kind);
  end
  name = '';
  if isfield(result.input, 'name')
    name = result.input.name;
  end
  title(handle, name, 'interpreter', 'none', 'fontweight', 'normal');
  set(handle, 'box', 'on', 'tickdir', 'in', 'xminortick', 'on', 'yminortick', 'on', 'layer', 'top');
end

function word = default_to(word, standard)
  if isempty(word)
    word = standard;
  end
end

function color = ink(number)
  % Distinct in print, in grey and for colour-blind eyes.
  colors = [18 40 92; 200 85 61; 27 138 107; 176 122 0] / 255;
  color = colors(1 + mod(number - 1, size(colors, 1)), :);
end

% The column, or an error that names what there is.
function values = numbers(columns, quantity)
  if ~isfield(columns, quantity)
    error('epicyclic:figure', 'epicyclic.plot: no column %s; there are %s', quantity, ...
          strjoin(fieldnames(columns).', ', '));
  end
  values = columns.(quantity);
  if ~isnumeric(values)
    error('epicyclic:figure', 'epicyclic.plot: column %s has texts, not numbers', quantity);
  end
end

function name = abscissa(result, table)
  name = 'value';
  if isfield(result.input.study, 'parameter') && isfield(result.(table), result.input.study.parameter)
    name = result.input.study.parameter;  % a study in rpm or Hz
  end
end

function label_axes(result, table, quantity, start)
  parameter = 'value';
  if isfield(result.input.study, 'parameter')
    parameter = result.input.study.parameter;
  end
  xlabel(strrep(parameter, '_', ' '), 'interpreter', 'none');
  ylabel([start label_of(result, table, quantity)], 'interpreter', 'none');
end

function text = label_of(result, table, quantity)
  text = quantity;
  if isfield(result.units, table) && isfield(result.units.(table), quantity)
    unit = result.units.(table).(quantity);
    if ~strcmp(unit, '1')
      text = [quantity '  [' unit ']'];
    end
  end
end

function draw_sweep(result, quantity, direction)
  points = result.points;
  x = points.(abscissa(result, 'points'));
  directions = unique(points.direction, 'stable');
  is_section = isfield(result, 'poincare') && isfield(result.poincare, quantity);
  handles = {};
  words = {};
  for k = numel(directions):-1:1
    if ~isempty(direction) && ~strcmp(direction, directions{k})
      continue
    end
    here = strcmp(points.direction, directions{k});
    if is_section
      [~, row] = ismember(result.poincare.point, points.point);
      chosen = here(row);
      handles{end + 1} = line(x(row(chosen)), result.poincare.(quantity)(chosen), 'linestyle', 'none', ...
                              'marker', '.', 'markersize', 3, 'color', ink(k)); %#ok<AGROW>
    else
      y = numbers(points, quantity);
      [sorted, order] = sort(x(here));
      y = y(here);
      y = y(order);
      regimes = points.regime(here);
      regular = ismember(regimes(order), {'periodic', 'quasiperiodic'});
      with_gaps = y;
      with_gaps(~regular) = NaN;
      handles{end + 1} = line(sorted, with_gaps, 'color', ink(k), 'linewidth', 1.2); %#ok<AGROW>
      line(sorted(~regular), y(~regular), 'linestyle', 'none', 'marker', 'o', 'markersize', 3, 'color', ink(k));
    end
    words{end + 1} = directions{k}; %#ok<AGROW>
  end
  if isempty(handles)
    error('epicyclic:figure', 'epicyclic.plot: no direction %s; there are %s', direction, strjoin(directions.', ', '));
  end
  if min(x) < max(x)
    xlim([min(x), max(x)]);
  end
  if is_section
    label_axes(result, 'poincare', quantity, 'Poincare points of ');
  else
    label_axes(result, 'points', quantity, '');
  end
  legend([handles{end:-1:1}], words(end:-1:1), 'location', 'northeastoutside');
end

function draw_cells(result, quantity, direction)
  points = result.points;
  if isempty(direction)
    direction = points.direction{1};
  end
  here = strcmp(points.direction, direction);
  if ~any(here)
    error('epicyclic:figure', 'epicyclic.plot: no direction %s', direction);
  end
  values = numbers(points, quantity);
  [first, ~, column] = unique(points.value(here));
  [second, ~, row] = unique(points.second_value(here));
  matrix = NaN(numel(second), numel(first));
  matrix(sub2ind(size(matrix), row, column)) = values(here);
  image_axes = imagesc(first, second, matrix);
  set(image_axes, 'alphadata', double(~isnan(matrix)));
  axis('xy');
  axis('tight');
  bar = colorbar();
  ylabel(bar, label_of(result, 'points', quantity), 'interpreter', 'none');
  study = result.input.study;
  xlabel(axis_name(study.first), 'interpreter', 'none');
  ylabel(axis_name(study.second), 'interpreter', 'none');
end

function name = axis_name(place)
  if isfield(place, 'parameter')
    name = strrep(place.parameter, '_', ' ');
  else
    name = place.component;
  end
end

function draw_branches(result, quantity)
  orbits = result.branch;
  x = orbits.(abscissa(result, 'branch'));
  is_section = isfield(result.poincare, quantity);
  handles = cell(1, 2);
  for branch = unique(orbits.branch).'
    rows = find(orbits.branch == branch);
    if is_section
      curves = crossings_of(result.poincare, branch, orbits.index(rows), quantity);
    else
      values = numbers(orbits, quantity);
      curves = values(rows);
    end
    stable = orbits.stable(rows) == 1;
    for k = 1:size(curves, 2)
      % A step between a stable and an unstable orbit belongs to the unstable line.
      of_stable = curves(:, k);
      of_stable(~stable) = NaN;
      of_unstable = curves(:, k);
      of_unstable(stable & [stable(2:end); true] & [true; stable(1:end-1)]) = NaN;
      handles{1} = line(x(rows), of_unstable, 'color', ink(2), 'linestyle', '--');
      handles{2} = line(x(rows), of_stable, 'color', ink(1), 'linewidth', 1.5);
    end
  end
  if is_section
    label_axes(result, 'poincare', quantity, 'Poincare points of ');
  else
    label_axes(result, 'branch', quantity, '');
  end
  legend([handles{[2, 1]}], {'stable', 'unstable'}, 'location', 'northeastoutside');
end

% One column for each Poincare point of an orbit.
function curves = crossings_of(section, branch, indices, quantity)
  here = section.branch == branch;
  curves = NaN(numel(indices), max([section.crossing(here); 0]) + 1);
  [known, row] = ismember(section.index(here), indices);
  crossing = section.crossing(here) + 1;
  values = section.(quantity)(here);
  curves(sub2ind(size(curves), row(known), crossing(known))) = values(known);
end

function draw_lines(result, table, x, quantity, words)
  columns = result.(table);
  line(columns.(x), numbers(columns, quantity), 'color', ink(1), 'linewidth', 1.2);
  xlim([min(columns.(x)), max(columns.(x))]);
  xlabel(words, 'interpreter', 'none');
  ylabel(label_of(result, table, quantity), 'interpreter', 'none');
end
