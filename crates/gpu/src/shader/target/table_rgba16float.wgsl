@group(1) @binding(1) var onelight_baked: texture_storage_3d<rgba16float, write>;
