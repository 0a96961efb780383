# A valley floor 80 m wide instead of 160 m.
BEGIN { half_width = 40 }
