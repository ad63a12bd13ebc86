function [f, facts] = rhs(file, varargin)
%RHS  Equations of motion of a stage, for ode45 and other solvers. GNU Octave only.
%
%   [f, facts] = epicyclic.rhs(file)
%   [f, facts] = epicyclic.rhs(file, 'sun_speed_rpm', 3000, ...)
%
%   The file is a study or an input.resolved.json. Further arguments are keys of "operation" with their values, in
%   place of the operating point of the study.
%
%   f(tau, y) is dy/dtau, with tau = omega_sn t, states in b_c and b_c per tau. y is a column, or a matrix with a state
%   in each column. facts has these fields:
%
%     names                  of the states, a cell array
%     start                  default initial state, a column
%     period                 of the equations in tau
%     mesh_frequency_ratio   Omega
%     omega_sn               reference frequency [rad/s]
%
%   The function needs rhs_mex.mex, which a build with EPICYCLIC_PYTHON makes. The equations have kinks at contacts: use
%   a tolerance of 1e-8 or less.
%
%   See also ode45, epicyclic.open.

  if exist('OCTAVE_VERSION', 'builtin') == 0
    error('epicyclic:form', 'epicyclic.rhs: its MEX file is for Octave');
  end
  if mod(numel(varargin), 2) ~= 0
    error('epicyclic:input', 'epicyclic.rhs: each key needs a value');
  end
  sets = '';
  if ~isempty(varargin)
    sets = sprintf('/operation={}\n');
  end
  for k = 1:2:numel(varargin)
    sets = [sets, sprintf('/operation/%s=%.17g\n', varargin{k}, varargin{k + 1})];
  end
  [handle, period, start, names, omega, omega_sn] = epicyclic.rhs_mex(file, sets);
  facts = struct('names', {strsplit(names, ',')}, 'start', start, 'period', period, 'mesh_frequency_ratio', omega, ...
                 'omega_sn', omega_sn);
  forget = onCleanup(@() epicyclic.rhs_mex(handle));
  f = @(tau, y) evaluate(handle, forget, tau, y);
end

function rate = evaluate(handle, forget, tau, y)  % forget: the model lives as long as f
  rate = epicyclic.rhs_mex(handle, tau, y);
end
