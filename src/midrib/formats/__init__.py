"""Vector files in and out: any format of GDAL's through pyogrio, and GeoParquet through pyarrow."""
