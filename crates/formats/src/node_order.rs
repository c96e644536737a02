use onelight_lut::Lut3d;

/// The node `[red, green, blue]` at a place in a table whose first index runs fastest.
pub(crate) fn node_at(index: usize, size: usize) -> [usize; 3] {
    [index % size, index / size % size, index / (size * size)]
}

/// The place of a node in a [`Lut3d`], where red runs fastest.
pub(crate) fn place_of([red, green, blue]: [usize; 3], size: usize) -> usize {
    red + size * (green + size * blue)
}

/// The nodes and entries of a table with blue fastest, as CLF and `.spi3d` have them.
pub(crate) fn blue_fastest(table: &Lut3d) -> impl Iterator<Item = ([usize; 3], [f32; 3])> {
    let size = table.size();
    // Every index is a node of the table, so none is left out.
    (0..size.pow(3)).filter_map(move |index| {
        let [blue, green, red] = node_at(index, size);
        let node = [red, green, blue];
        table.entry(node).map(|entry| (node, entry))
    })
}
