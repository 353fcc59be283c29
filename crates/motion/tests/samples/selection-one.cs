Get the records from where they are, 
 
one by one, 
 
and take care. 
 
Record Number 	 Record Sequence Number 	 Scale Factor 	 Component Number 	 File Name 	 URL 
1 	 12 	   1.25 	 2 	 EVENT\STA090.AT2 	 here/EVENT\STA090.AT2 
