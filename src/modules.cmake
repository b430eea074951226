# The modules of Hooke from the bottom up, and the modules that each may use. src/CMakeLists.txt builds a library for each module and
# links it with those it uses, tests/layers.cmake checks the includes, and docs/development/architecture.md shows the table as a diagram.
# A module is the folder of its name; those of the physics are in sim.

set(physics_modules model plan forces contact methods step control statics)
set(hooke_modules base ${physics_modules} scene formats edit lab study draw ui app batch cli python api)

# The folder of a module in src.
function(folder_of module result)
  if(module IN_LIST physics_modules)
    set(${result} sim/${module} PARENT_SCOPE)
  else()
    set(${result} ${module} PARENT_SCOPE)
  endif()
endfunction()

set(base_uses)
set(model_uses base)
set(plan_uses base model)
set(forces_uses base model plan)
set(contact_uses base model plan forces)
set(methods_uses base model plan forces)
set(step_uses base model plan forces contact methods)
set(control_uses base model plan forces contact methods step)
set(statics_uses base model plan forces methods)
set(physics base ${physics_modules})
set(scene_uses ${physics})
set(formats_uses ${physics} scene)
set(edit_uses ${physics} scene formats)
set(lab_uses ${physics} scene formats edit)
set(study_uses ${physics} scene formats edit lab)
set(draw_uses ${physics} scene)
set(ui_uses ${physics} scene formats edit lab study draw)
set(app_uses ${physics} scene formats edit lab study draw ui)
set(batch_uses ${physics} scene formats edit lab study draw ui)
set(cli_uses ${physics} scene formats edit lab study draw ui batch)
set(python_uses ${physics} scene formats edit lab study draw ui batch)
set(api_uses ${physics} scene formats edit lab)
