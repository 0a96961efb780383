# A valley floor 30 m wide instead of 160 m.
BEGIN { half_width = 15 }
