"""Drawing sheets in millimetres: graphs with their scales, as students hand them in, as SVG, PDF and DXF."""
