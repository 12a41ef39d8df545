# What every public header must pass.
macro(_gnomon_header_checks)
endmacro()
