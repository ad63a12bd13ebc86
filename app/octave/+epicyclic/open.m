function result = open(folder, form)
%OPEN  Read a result folder of the program epicyclic.
%
%   result = epicyclic.open(folder)
%   result = epicyclic.open(folder, 'table')      MATLAB only
%
%   The folder must be finished. The result is a struct:
%
%     result.folder, result.kind    path of the folder, and kind of the study
%     result.input                  the complete study, from input.resolved.json
%     result.points.COLUMN          a column of points.csv: column vector of doubles, or cell array of texts
%     result.poincare.COLUMN, ...   the other tables, one struct each
%     result.units.points.COLUMN    unit of the column, such as 'N'; '1' stands for no dimension
%     result.meaning.points.COLUMN  a line about the column
%     result.matrices               data with two axes: rows first, columns second
%
%   With 'table' the tables are MATLAB tables, with VariableUnits and VariableDescriptions.
%
%   Tables come from results.h5, and from the CSV files if results.h5 does not have them. Units are known of
%   results.h5 only. An unknown number is NaN. Errors have the identifiers epicyclic:folder (no result folder),
%   epicyclic:unfinished and epicyclic:damaged.
%
%   See also epicyclic.plot.

  if nargin < 2
    form = 'struct';
  end
  if ~any(strcmp(form, {'struct', 'table'}))
    error('epicyclic:form', 'epicyclic.open: the form is ''struct'' or ''table'', not ''%s''', form);
  end
  if strcmp(form, 'table') && exist('OCTAVE_VERSION', 'builtin') ~= 0
    error('epicyclic:form', 'epicyclic.open: Octave has no tables; use the struct');
  end
  run = read_run(folder);
  result = struct('folder', folder, 'kind', '');
  result.input = read_json(fullfile(folder, 'input.resolved.json'));
  result.units = struct();
  result.meaning = struct();
  result.matrices = struct();

  file = fullfile(folder, 'results.h5');
  if exist(file, 'file') == 2
    result = add_hdf5(result, file);
  end
  result = add_csv(result, folder);
  result.kind = kind_of(result, folder);
  result.version = run.version;
  if strcmp(form, 'table')
    result = with_tables(result);
  end
end

% Folder and study -----------------------------------------------------------------------------------------------------

function run = read_run(folder)
  if exist(folder, 'dir') ~= 7
    error('epicyclic:folder', '%s: no such folder', folder);
  end
  file = fullfile(folder, 'run.json');
  if exist(file, 'file') ~= 2
    error('epicyclic:folder', '%s: is not a result folder of epicyclic: it has no run.json', folder);
  end
  run = read_json(file);
  if ~isfield(run, 'program') || ~strcmp(run.program, 'epicyclic')
    error('epicyclic:folder', '%s: run.json is not from epicyclic', folder);
  end
  if ~isfield(run, 'state') || ~strcmp(run.state, 'complete')
    error('epicyclic:unfinished', '%s: the study is not finished; repeat its command, which resumes it', folder);
  end
end

function value = read_json(file)
  try
    value = jsondecode(fileread(file));
  catch problem
    error('epicyclic:damaged', '%s: is damaged: %s', file, problem.message);
  end
end

function kind = kind_of(result, folder)
  kind = 'gear';
  if isfield(result.input, 'study') && isfield(result.input.study, 'kind')
    kind = result.input.study.kind;
  end
  if exist(fullfile(folder, 'geometry.csv'), 'file') == 2
    kind = 'gear';
  end
end

% results.h5 -----------------------------------------------------------------------------------------------------------

function result = add_hdf5(result, file)
  try
    if exist('OCTAVE_VERSION', 'builtin') ~= 0
      groups = load('-hdf5', file);
    else
      groups = read_group(file, h5info(file));
    end
  catch problem
    error('epicyclic:damaged', '%s: is damaged: %s', file, problem.message);
  end
  if isfield(groups, 'columns')
    list = groups.columns;
    groups = rmfield(groups, 'columns');
    result = add_words(result, texts_of(list.path), texts_of(list.units), texts_of(list.meaning));
  end
  names = fieldnames(groups);
  for k = 1:numel(names)
    [columns, matrices] = split_group(groups.(names{k}));
    result.(names{k}) = columns;
    if ~isempty(fieldnames(matrices))
      result.matrices.(names{k}) = matrices;
    end
  end
end

% The groups of a file as nested structs, as Octave's load has them.
function group = read_group(file, info)
  group = struct();
  for k = 1:numel(info.Datasets)
    path = [strip_slash(info.Name) '/' info.Datasets(k).Name];
    group.(info.Datasets(k).Name) = h5read(file, path);
  end
  for k = 1:numel(info.Groups)
    parts = strsplit(info.Groups(k).Name, '/');
    group.(parts{end}) = read_group(file, info.Groups(k));
  end
end

function name = strip_slash(name)
  if strcmp(name, '/')
    name = '';
  end
end

function result = add_words(result, paths, units, meanings)
  for k = 1:numel(paths)
    parts = strsplit(paths{k}, '/');
    if numel(parts) ~= 2 || ~isvarname(parts{1}) || ~isvarname(parts{2})
      continue
    end
    if ~isempty(units{k})
      result.units.(parts{1}).(parts{2}) = units{k};
    end
    if ~isempty(meanings{k})
      result.meaning.(parts{1}).(parts{2}) = meanings{k};
    end
  end
end

% Data with one axis as columns; those with two axes apart, rows first.
function [columns, matrices] = split_group(group)
  columns = struct();
  matrices = struct();
  names = fieldnames(group);
  for k = 1:numel(names)
    name = names{k};
    value = group.(name);
    if isstruct(value)
      [inner, inner_matrices] = split_group(value);
      columns.(name) = inner;
      if ~isempty(fieldnames(inner_matrices))
        matrices.(name) = inner_matrices;
      end
    elseif is_text(value)
      columns.(name) = texts_of(value);
    elseif isvector(value) || isempty(value)
      if ~strcmp(name, 'row')
        columns.(name) = double(value(:));
      end
    else
      matrices.(name) = double(value).';  % both programs reverse the axes of HDF5
    end
  end
end

function yes = is_text(value)
  yes = ischar(value) || iscell(value) || isa(value, 'string');
end

% Texts as a cell array, one column. Their padding is blanks or zero bytes.
function texts = texts_of(value)
  if isempty(value)
    texts = cell(0, 1);
    return
  end
  texts = cellstr(value);
  texts = deblank(strrep(texts(:), char(0), ''));
end

% CSV ------------------------------------------------------------------------------------------------------------------

function result = add_csv(result, folder)
  files = dir(fullfile(folder, '*.csv'));
  for k = 1:numel(files)
    [~, stem] = fileparts(files(k).name);
    file = fullfile(folder, files(k).name);
    header = strsplit(first_line(file), ',');
    % branch.csv has the columns of the group branches, and branches.csv has others.
    if strcmp(stem, 'branch') && isfield(result, 'branches')
      result.branch = result.branches;
      result = rmfield(result, 'branches');
      result = move_words(result, 'branches', 'branch');
    end
    if isfield(result, stem) && all(isfield(result.(stem), header))
      % In the order of the file.
      result.(stem) = orderfields_as(result.(stem), header);
    else
      result.(stem) = read_csv(file);
    end
  end
end

function result = move_words(result, from, to)
  for field = {'units', 'meaning'}
    if isfield(result.(field{1}), from)
      result.(field{1}).(to) = result.(field{1}).(from);
      result.(field{1}) = rmfield(result.(field{1}), from);
    end
  end
end

function ordered = orderfields_as(columns, header)
  ordered = struct();
  for k = 1:numel(header)
    ordered.(header{k}) = columns.(header{k});
  end
end

function line = first_line(file)
  stream = fopen(file, 'r');
  if stream < 0
    error('epicyclic:damaged', '%s: cannot be read', file);
  end
  line = fgetl(stream);
  fclose(stream);
  if ~ischar(line)
    error('epicyclic:damaged', '%s: is empty; repeat the command of the folder to restore it', file);
  end
end

function columns = read_csv(file)
  text = fileread(file);
  lines = sum(text == sprintf('\n'));
  if ~any(text == '"')
    cells = strsplit(strrep(text(1:end-1), sprintf('\n'), ','), ',', 'CollapseDelimiters', false);
  else
    lines = 0;
    cells = {};
    tokens = regexp(text, '("(?:[^"]|"")*"|[^,\n]*)(,|\n)', 'tokens');
    for k = 1:numel(tokens)
      cell_text = tokens{k}{1};
      if ~isempty(cell_text) && cell_text(1) == '"'
        cell_text = strrep(cell_text(2:end-1), '""', '"');
      end
      cells{k} = cell_text; %#ok<AGROW>
      lines = lines + (tokens{k}{2} == sprintf('\n'));
    end
  end
  width = numel(cells) / lines;
  if lines < 1 || width ~= round(width)
    error('epicyclic:damaged', '%s: lines differ in length; repeat the command of the folder to restore it', file);
  end
  cells = reshape(cells, width, lines).';
  columns = struct();
  for k = 1:width
    name = cells{1, k};
    if ~isvarname(name)
      name = matlab.lang.makeValidName(name);
    end
    columns.(name) = numbers_or_texts(cells(2:end, k));
  end
end

% Doubles if each cell is a number or empty, and one is a number.
function column = numbers_or_texts(cells)
  numbers = str2double(cells);
  empty = cellfun(@isempty, cells);
  known = ~isnan(numbers) & imag(numbers) == 0;
  if all(known | empty) && any(known)
    column = real(numbers(:));
  else
    column = cells(:);
  end
end

% MATLAB tables --------------------------------------------------------------------------------------------------------

function result = with_tables(result)
  names = fieldnames(result);
  for k = 1:numel(names)
    name = names{k};
    columns = result.(name);
    if any(strcmp(name, {'input', 'units', 'meaning', 'matrices'})) || ~isstruct(columns) || ~is_table(columns)
      continue
    end
    made = struct2table(columns);
    variables = made.Properties.VariableNames;
    made.Properties.VariableUnits = words_for(result.units, name, variables);
    made.Properties.VariableDescriptions = words_for(result.meaning, name, variables);
    result.(name) = made;
  end
end

function yes = is_table(columns)
  lengths = structfun(@numel, columns);
  yes = ~isempty(lengths) && all(lengths == lengths(1)) && ~any(structfun(@isstruct, columns));
end

function words = words_for(all_words, name, variables)
  words = repmat({''}, 1, numel(variables));
  for k = 1:numel(variables)
    if isfield(all_words, name) && isfield(all_words.(name), variables{k})
      words{k} = all_words.(name).(variables{k});
    end
  end
end
