# Banks of 38 degrees instead of 35.
BEGIN { steep = 0.78129 }
