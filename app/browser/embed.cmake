# cmake -D FOLDER=app/browser -D OUTPUT=browser_files.cpp -P embed.cmake
#
# The files of a report as C++: page.html, style.css, uPlot with its licence, and the modules as one script. The modules
# have no names in common and import nothing but each other, so that they are joined by leaving out `import` and `export`.
# Texts are always quoted here: as a list, they would lose brackets and semicolons.
set(modules payload words theme panel choice changes diagram details chart plane run modes summary live page)

foreach(module IN LISTS modules)
  file(READ "${FOLDER}/${module}.js" text)
  set(text "\n${text}")
  string(REGEX REPLACE "\nimport [^;]*;" "\n" text "${text}")
  string(REPLACE "\nexport " "\n" text "${text}")
  string(APPEND joined "${text}")
endforeach()
file(READ "${FOLDER}/vendor/uPlot.iife.min.js" plot)
file(READ "${FOLDER}/vendor/LICENSE" licence)
file(READ "${FOLDER}/vendor/uPlot.min.css" plot_style)
file(READ "${FOLDER}/style.css" own_style)

file(READ "${FOLDER}/page.html" page)
set(style "${plot_style}\n${own_style}")
set(plot "/*! uPlot\n${licence}*/\n${plot}")
set(program "'use strict';(() => {${joined}})();\n")

# Characters one by one: compilers need not take a longer literal than 65536.
set(source "// Made by app/browser/embed.cmake.\n#include \"report/report_page.hpp\"\n\nnamespace epicyclic::app::browser {\n")
foreach(name IN ITEMS page style plot program)
  string(HEX "${${name}}" hex)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," characters "${hex}")
  string(APPEND source "\nstatic constexpr char ${name}_characters[] = {${characters}};\n"
                       "const std::string_view ${name}{${name}_characters, sizeof ${name}_characters};\n")
endforeach()
string(APPEND source "\n}  // namespace epicyclic::app::browser\n")
file(WRITE "${OUTPUT}" "${source}")
