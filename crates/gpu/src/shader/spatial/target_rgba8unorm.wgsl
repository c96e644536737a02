@group(2) @binding(1) var onelight_target: texture_storage_2d<rgba8unorm, write>;
