# Install and export.
function(_gnomon_install_module name)
endfunction()
