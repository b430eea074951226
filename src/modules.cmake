# The modules of Hooke from the bottom up, and the modules that each may use. src/CMakeLists.txt builds a library for each module and
# links it with those it uses, tests/layers.cmake checks the includes, and docs/architecture.md shows the table as a diagram.

set(hooke_modules base sim scene formats edit lab study draw ui app batch cli python api)

set(base_uses)
set(sim_uses base)
set(scene_uses base sim)
set(formats_uses base sim scene)
set(edit_uses base sim scene formats)
set(lab_uses base sim scene formats edit)
set(study_uses base sim scene formats edit lab)
set(draw_uses base sim scene)
set(ui_uses base sim scene formats edit lab study draw)
set(app_uses base sim scene formats edit lab study draw ui)
set(batch_uses base sim scene formats edit lab study draw ui)
set(cli_uses base sim scene formats edit lab study draw ui batch)
set(python_uses base sim scene formats edit lab study draw ui batch)
set(api_uses base sim scene formats edit lab)
