% Results of the program as epicyclic.open reads them, in the folder out/. Ends with "all read", or an error.
function reading()
  kinds = {'speed', 'sweep'; 'rpm', 'sweep'; 'map', 'map'; 'basins', 'basins'; 'run', 'run'; 'branches', 'continue'; ...
           'tolerance', 'tolerance'; 'crosscheck', 'crosscheck'; 'gear', 'gear'};
  for k = 1:size(kinds, 1)
    folder = fullfile('out', kinds{k, 1});
    result = epicyclic.open(folder);
    assert(result.kind, kinds{k, 2});
    files = dir(fullfile(folder, '*.csv'));
    assert(numel(files) > 0);
    for n = 1:numel(files)
      [~, stem] = fileparts(files(n).name);
      same_as_file(result.(stem), fullfile(folder, files(n).name));
    end
  end

  sweep = epicyclic.open('out/speed');
  assert(sweep.units.points.force_sp_max, 'N');
  assert(sweep.units.poincare.x_s_rate, 'b_c per tau');
  assert(~isempty(sweep.meaning.points.force_sp_max));
  assert(sweep.input.study.points, 4);
  assert(sum(sweep.poincare.point == 3), 8);
  assert(size(sweep.matrices.spectra.delta_sp_1, 1), 8);  % rows first: a row for each point
  map = epicyclic.open('out/map');
  assert(size(map.matrices.map.up.period), [2, 3]);
  run = epicyclic.open('out/run');
  assert(run.units.history.force_sp_1, 'N');
  branches = epicyclic.open('out/branches');
  assert(branches.units.branch.value, 'of the parameter');
  assert(~isfield(branches.units, 'branches'));

  % Everything of a file by load itself.
  for name = {'speed', 'map', 'basins', 'run', 'branches'}
    groups = load(fullfile('out', name{1}, 'results.h5'));
    assert(isfield(groups, 'columns'));
  end

  draws = {'speed', '', ''; 'speed', 'delta_rp_1', 'down'; 'speed', 'delta_sp_rms', ''; 'rpm', '', ''; ...
           'map', '', 'down'; 'map', 'delta_sp_rms', ''; 'basins', '', ''; 'run', '', ''; 'run', 'force_sp_2', ''; ...
           'branches', '', ''; 'branches', 'delta_sp_rms', ''; 'gear', '', ''};
  for k = 1:size(draws, 1)
    clf();
    handle = epicyclic.plot(epicyclic.open(fullfile('out', draws{k, 1})), draws{k, 2}, draws{k, 3});
    assert(~isempty(get(handle, 'children')));
    assert(~isempty(get(get(handle, 'xlabel'), 'string')) && ~isempty(get(get(handle, 'ylabel'), 'string')));
  end
  refused(@() epicyclic.plot(sweep, 'no_such'), 'epicyclic:figure', 'no column no_such');
  refused(@() epicyclic.plot(sweep, 'status'), 'epicyclic:figure', 'has texts');
  refused(@() epicyclic.plot(sweep, '', 'left'), 'epicyclic:figure', 'no direction');
  refused(@() epicyclic.plot(epicyclic.open('out/tolerance')), 'epicyclic:figure', 'no figure');

  refused(@() epicyclic.open('none'), 'epicyclic:folder', 'no such folder');
  refused(@() epicyclic.open('.'), 'epicyclic:folder', 'no run.json');
  refused(@() epicyclic.open('out/speed', 'matrix'), 'epicyclic:form', 'not ''matrix''');
  refused(@() epicyclic.open('out/speed', 'table'), 'epicyclic:form', 'Octave has no tables');
  copied = copy_of('out/speed');
  put(fullfile(copied, 'run.json'), strrep(fileread(fullfile(copied, 'run.json')), '"complete"', '"running"'));
  refused(@() epicyclic.open(copied), 'epicyclic:unfinished', 'not finished');
  put(fullfile(copied, 'run.json'), '{');
  refused(@() epicyclic.open(copied), 'epicyclic:damaged', 'run.json: is damaged');
  copied = copy_of('out/speed');
  delete(fullfile(copied, 'results.h5'));
  same_as_file(getfield(epicyclic.open(copied), 'points'), fullfile(copied, 'points.csv'));
  text = fileread(fullfile(copied, 'points.csv'));
  put(fullfile(copied, 'points.csv'), [text(1:round(end / 2)) sprintf('\n')]);
  refused(@() epicyclic.open(copied), 'epicyclic:damaged', 'points.csv');
  put(fullfile(copied, 'points.csv'), '');
  refused(@() epicyclic.open(copied), 'epicyclic:damaged', 'points.csv: is empty');
  put(fullfile(copied, 'points.csv'), sprintf('a,b,c\n1,"x, ""y""",\n2,,\n'));
  points = getfield(epicyclic.open(copied), 'points');
  assert(points.a, [1; 2]);
  assert(points.b, {'x, "y"'; ''});
  copied = copy_of('out/speed');
  put(fullfile(copied, 'results.h5'), 'no HDF5');
  refused(@() epicyclic.open(copied), 'epicyclic:damaged', 'results.h5: is damaged');
  printf('all read\n');
end

% Header and cells of the file, read line by line.
function same_as_file(columns, file)
  text = fileread(file);
  lines = strsplit(text(1:end-1), sprintf('\n'));
  names = strsplit(lines{1}, ',');
  assert(fieldnames(columns).', names);
  plain = cellfun(@(line) ~any(line == '"'), lines(2:end));
  if ~any(plain)
    return
  end
  cells = cellfun(@(line) strsplit(line, ',', 'CollapseDelimiters', false), lines(1 + find(plain)), ...
                  'UniformOutput', false);
  cells = vertcat(cells{:});
  for n = 1:numel(names)
    column = columns.(names{n});
    assert(size(column), [numel(lines) - 1, 1]);
    if iscell(column)
      assert(isequal(column(plain), cells(:, n)), [file ' ' names{n}]);
    else
      assert(isequaln(column(plain), str2double(cells(:, n))), [file ' ' names{n}]);
    end
  end
end

function refused(call, identifier, words)
  try
    call();
  catch problem
    assert(problem.identifier, identifier);
    assert(~isempty(strfind(problem.message, words)), problem.message);
    return
  end
  error('not refused: %s', func2str(call));
end

function folder = copy_of(from)
  folder = tempname(pwd());
  copyfile(from, folder);
end

function put(file, text)
  stream = fopen(file, 'w');
  fwrite(stream, text);
  fclose(stream);
end
